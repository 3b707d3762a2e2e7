/* Times kernels in turns: every round, each of them runs once over all inputs. */

#include <time.h>

/* One call of a peer: `count` states, laid out as q of all, qd of all, qdd of all; `single` wherever count is 1. */
typedef void single_kernel(const double *x, double *out);
typedef void returning_kernel(double *out, const double *x); /* of Rust: what it returns, it is told where to put */
typedef void batch_kernel(const double *x, long count, double *out);

struct peer {
    single_kernel *single;
    returning_kernel *returning; /* used where `single` is null */
    batch_kernel *batch;         /* used where both are null */
};

static double now(void) {
    struct timespec t;
    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void pass(const struct peer *peer, const double *states, const double *blocks, int width, int count, int block,
                 double *out) {
    if (peer->single)
        for (int i = 0; i < count; ++i) peer->single(states + i * width, out);
    else if (peer->returning)
        for (int i = 0; i < count; ++i) peer->returning(out, states + i * width);
    else
        for (int i = 0; i < count; i += block) peer->batch(blocks + i * width, block, out);
}

/* seconds[round * peers + k]: peer k's time for a state, on average over `count` of them. `states` are one after the other,
 * `blocks` the same states in blocks for batches; both `width` numbers a state. Results go to memory, written by functions that
 * the compiler cannot see into, so that none is left out. */
void time_in_turns(const struct peer *peer, int peers, const double *states, const double *blocks, int width, int count,
                   int block, int rounds, double *out, double *seconds) {
    for (int round = 0; round < rounds; ++round)
        for (int turn = 0; turn < peers; ++turn) {
            int k = (turn + round) % peers;
            pass(&peer[k], states, blocks, width, block, block, out); /* what the last peer left in the caches is not k's fault */
            double start = now();
            pass(&peer[k], states, blocks, width, count, block, out);
            seconds[round * peers + k] = (now() - start) / count;
        }
}
