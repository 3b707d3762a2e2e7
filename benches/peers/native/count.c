/* Runs kernels under callgrind, which writes the instructions of each to a file of its own: count LIBRARY ARM QUANTITY ... */

#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <valgrind/callgrind.h>

#define CALLS 16
#define LARGEST 8192 /* numbers in a result or a state */

typedef void kernel(double *out, const double *x); /* as returning_kernel in timer.c */
typedef kernel *find_kernel(const char *arm, const char *quantity);

static double x[CALLS][LARGEST], out[LARGEST];

int main(int count, char **words) {
    void *library = count > 1 ? dlopen(words[1], RTLD_NOW) : 0;
    find_kernel *find = library ? (find_kernel *)dlsym(library, "kernel") : 0;
    if (!find) return fprintf(stderr, "count: no kernels in %s\n", count > 1 ? words[1] : "(no library)"), 1;
    srand48(1);
    for (int call = 0; call < CALLS; ++call)
        for (int i = 0; i < LARGEST; ++i) x[call][i] = 2 * drand48() - 1;
    for (int word = 2; word + 1 < count; word += 2) {
        kernel *run = find(words[word], words[word + 1]);
        if (!run) return fprintf(stderr, "count: no %s of %s\n", words[word + 1], words[word]), 1;
        run(out, x[0]); /* what happens once only is not counted */
        CALLGRIND_ZERO_STATS;
        for (int call = 0; call < CALLS; ++call) run(out, x[call]);
        CALLGRIND_DUMP_STATS_AT(words[word + 1]);
    }
    return 0;
}
