/* Calls an arm's functions as casadi.external does, and says what is wrong. Compiled with ARM (its name), HEADER and OTHER (its files), JOINTS and PAYLOAD (0 or 1). */

#include HEADER
#include OTHER

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define JOIN(a, b) a##b
#define JOINED(a, b) JOIN(a, b)
#define INPUTS (3 + PAYLOAD)
#define PARAMETERS 10
#define LONGEST (JOINTS > PARAMETERS ? JOINTS : PARAMETERS)
#define STATES 20

typedef struct
{
    int (*evaluate)(const double **, double **, long long int *, double *, int);
    int (*work)(long long int *, long long int *, long long int *, long long int *);
    long long int (*n_in)(void);
    long long int (*n_out)(void);
    const char *(*name_in)(long long int);
    const char *(*name_out)(long long int);
    const long long int *(*sparsity_in)(long long int);
    const long long int *(*sparsity_out)(long long int);
    double (*default_in)(long long int);
    int (*checkout)(void);
    void (*release)(int);
    void (*incref)(void);
    void (*decref)(void);
} external;

#define EXTERNAL(f) \
    {f, f##_work, f##_n_in, f##_n_out, f##_name_in, f##_name_out, f##_sparsity_in, f##_sparsity_out, \
     f##_default_in, f##_checkout, f##_release, f##_incref, f##_decref}
#define EXTERNAL_OF(f) EXTERNAL(f)
#define VALUE(method) EXTERNAL_OF(JOINED(ARM, _casadi_##method))
#define JACOBIAN(method) EXTERNAL_OF(JOINED(jac_, JOINED(ARM, _casadi_##method)))

static int failures = 0;

static void check(int holds, const char *what)
{
    if (!holds)
    {
        printf("not so: %s\n", what);
        failures++;
    }
}

static double random_number(void)
{
    static unsigned long long int state = 1;
    state = state * 6364136223846793005ULL + 1442695040888963407ULL;
    return 2.0 * (double)(state >> 11) / 9007199254740992.0 - 1.0;
}

static long long int entries_of(const long long int *sparsity)
{
    return sparsity[2] == 1 ? sparsity[0] * sparsity[1] : sparsity[2 + sparsity[1]];
}

/* All of a matrix by columns, of the entries that there are. */
static void spread(const long long int *sparsity, const double *entries, double *matrix)
{
    long long int rows = sparsity[0], columns = sparsity[1], j, k;
    for (k = 0; k < rows * columns; k++) matrix[k] = sparsity[2] == 1 ? entries[k] : 0.0;
    if (sparsity[2] == 1) return;
    for (j = 0; j < columns; j++)
        for (k = sparsity[2 + j]; k < sparsity[3 + j]; k++)
        {
            long long int row = sparsity[3 + columns + k];
            check(row >= 0 && row < rows, "rows of a sparsity are within it");
            check(k == sparsity[2 + j] || row > sparsity[2 + columns + k], "rows of a column rise");
            matrix[rows * j + row] = entries[k];
        }
}

static void interface(const external *f, int inputs, int outputs, const char *const *in, const char *const *out, const int *columns)
{
    long long int arg = -1, res = -1, iw = -1, w = -1;
    int i;
    check(f->n_in() == inputs, "as many inputs as are named");
    check(f->n_out() == outputs, "as many outputs as are named");
    check(f->work(&arg, &res, &iw, &w) == 0 && f->work(0, 0, 0, 0) == 0, "work sizes are told, and need not be");
    check(arg == inputs && res == outputs && iw == 0 && w == 0, "work sizes");
    for (i = 0; i < inputs; i++)
    {
        const long long int *sparsity = f->sparsity_in(i);
        int length = i == 3 && PAYLOAD ? PARAMETERS : JOINTS;
        check(strcmp(f->name_in(i), in[i]) == 0, in[i]);
        check(sparsity[0] == length && sparsity[1] == 1, "an input is a vector");
        check(entries_of(sparsity) == (i < INPUTS ? length : 0), "an input is full, what is not used empty");
        check(f->default_in(i) == 0.0, "inputs are 0 where none is given");
    }
    for (i = 0; i < outputs; i++)
    {
        check(strcmp(f->name_out(i), out[i]) == 0, out[i]);
        check(f->sparsity_out(i)[0] == JOINTS && f->sparsity_out(i)[1] == columns[i], "the shape of an output");
    }
    check(!f->name_in(-1) && !f->name_in(inputs) && !f->name_out(-1) && !f->name_out(outputs), "no name beyond the last");
    check(!f->sparsity_in(-1) && !f->sparsity_in(inputs) && !f->sparsity_out(-1) && !f->sparsity_out(outputs), "no sparsity beyond the last");
    f->incref();
    f->release(f->checkout());
    f->decref();
}

typedef void plain_call(double x[4][LONGEST], double *result);

static void inverse_dynamics(double x[4][LONGEST], double *result)
{
    JOINED(ARM, _inverse_dynamics)
#if PAYLOAD
    (x[0], x[1], x[2], x[3], result);
#else
    (x[0], x[1], x[2], result);
#endif
}

static void forward_dynamics(double x[4][LONGEST], double *result)
{
    JOINED(ARM, _forward_dynamics)
#if PAYLOAD
    (x[0], x[1], x[2], x[3], result);
#else
    (x[0], x[1], x[2], result);
#endif
}

static void numbers(const external *value, const external *jacobian, plain_call *plain)
{
    double x[4][LONGEST], zeros[4][LONGEST] = {{0}}, got[JOINTS], expected[JOINTS];
    double blocks[4][JOINTS * LONGEST], alone[JOINTS * LONGEST], matrix[JOINTS * LONGEST];
    const double *arg[5] = {x[0], x[1], x[2], x[3], 0}, *none[5] = {0};
    double *res[4] = {got, 0, 0, 0};
    int state, i, j, k;
    for (state = 0; state < STATES; state++)
    {
        for (i = 0; i < 3; i++)
            for (j = 0; j < JOINTS; j++) x[i][j] = random_number();
        /* A body, not far from the tool. */
        for (j = 0; j < PARAMETERS; j++) x[3][j] = (j == 0 ? 1.0 : j == 4 || j == 7 || j == 9 ? 0.2 : 0.05 * random_number());
        arg[INPUTS] = 0;
        check(value->evaluate(arg, res, 0, 0, 0) == 0, "a function returns 0");
        plain(x, expected);
        check(memcmp(got, expected, sizeof got) == 0, "the value is that of the method, to the bit");

        for (i = 0; i < INPUTS; i++) res[i] = blocks[i];
        check(jacobian->evaluate(arg, res, 0, 0, 0) == 0, "a Jacobian returns 0");
        for (i = 0; i < INPUTS; i++)
        {
            const long long int *sparsity = jacobian->sparsity_out(i);
            int columns = (int)sparsity[1];
            double largest = 1e-3, worst = 0.0;
            double *one[4] = {0};
            one[i] = alone;
            check(jacobian->evaluate(arg, one, 0, 0, 0) == 0, "a Jacobian returns 0");
            check(memcmp(alone, blocks[i], (size_t)entries_of(sparsity) * sizeof(double)) == 0, "a block alone is what it is among all");
            spread(sparsity, blocks[i], matrix);
            for (j = 0; j < columns; j++)
            {
                const double h = 1e-5, at = x[i][j];
                double above[JOINTS], below[JOINTS];
                x[i][j] = at + h;
                plain(x, above);
                x[i][j] = at - h;
                plain(x, below);
                x[i][j] = at;
                for (k = 0; k < JOINTS; k++)
                {
                    double difference = fabs((above[k] - below[k]) / (2 * h) - matrix[JOINTS * j + k]);
                    largest = fmax(largest, fabs(matrix[JOINTS * j + k]));
                    worst = fmax(worst, difference);
                }
            }
            check(worst <= 1e-6 * largest, jacobian->name_out(i));
        }
        for (i = 0; i < 4; i++) res[i] = 0;
        check(jacobian->evaluate(arg, res, 0, 0, 0) == 0 && value->evaluate(arg, res, 0, 0, 0) == 0, "nothing need be wanted");
        res[0] = got;
    }
    value->evaluate(none, res, 0, 0, 0);
    plain(zeros, expected);
    check(memcmp(got, expected, sizeof got) == 0, "inputs that are not given are 0");
    for (i = 0; i < INPUTS; i++) res[i] = blocks[i];
    check(jacobian->evaluate(none, res, 0, 0, 0) == 0, "a Jacobian takes no inputs for zeros");
    for (i = 0; i < INPUTS; i++)
        for (j = 0; j < entries_of(jacobian->sparsity_out(i)); j++) check(isfinite(blocks[i][j]), "all entries are written");
}

int main(void)
{
    static const external id = VALUE(inverse_dynamics), jac_id = JACOBIAN(inverse_dynamics);
    static const external fd = VALUE(forward_dynamics), jac_fd = JACOBIAN(forward_dynamics);
    static const int one[] = {1}, columns[] = {JOINTS, JOINTS, JOINTS, PARAMETERS};
#if PAYLOAD
    static const char *const id_in[] = {"q", "qd", "qdd", "payload", "out_tau"}, *const fd_in[] = {"q", "qd", "tau", "payload", "out_qdd"};
#else
    static const char *const id_in[] = {"q", "qd", "qdd", "out_tau"}, *const fd_in[] = {"q", "qd", "tau", "out_qdd"};
#endif
    static const char *const tau[] = {"tau"}, *const qdd[] = {"qdd"};
    static const char *const jac_tau[] = {"jac_tau_q", "jac_tau_qd", "jac_tau_qdd", "jac_tau_payload"};
    static const char *const jac_qdd[] = {"jac_qdd_q", "jac_qdd_qd", "jac_qdd_tau", "jac_qdd_payload"};
    interface(&id, INPUTS, 1, id_in, tau, one);
    interface(&fd, INPUTS, 1, fd_in, qdd, one);
    interface(&jac_id, INPUTS + 1, INPUTS, id_in, jac_tau, columns);
    interface(&jac_fd, INPUTS + 1, INPUTS, fd_in, jac_qdd, columns);
    numbers(&id, &jac_id, inverse_dynamics);
    numbers(&fd, &jac_fd, forward_dynamics);
    return failures != 0;
}
