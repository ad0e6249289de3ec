/* Each linear move of a machine head is proved clear of clamps before it is made. The same program
 * in Rust: core/examples/keep_out.
 *
 * The head is a cutter, which is a capsule, and a nose, which is a box. msw_solid_first_contact
 * asks about the whole move, so a thin wall cannot be missed between two positions. Only a proof
 * lets the head go: a move that is undecided is refused as one that collides.
 */

#include "board.h"
#include "clamps.h"
#include "meshsweep.h"

#define KEEP 1.0f /* distance to keep, mm */

/* The middle of the tip's ball is the place of the head. */
#define CUTTER_RADIUS 3.0f
static const float cutter[2][3] = {{0, 0, 0}, {0, 0, 20}};
static const float nose[8][3] = {
    {-12, -12, 20}, {12, -12, 20}, {-12, 12, 20}, {12, 12, 20},
    {-12, -12, 80}, {12, -12, 80}, {-12, 12, 80}, {12, 12, 80},
};

/* Two clamps reach over the table, at x from 0 to 30 and from 70 to 100. Their tops are at 28. */
static const float start[3] = {50, 8, 60};
enum { MOVES = 8 };
static const float moves[MOVES][3] = {
    {50, 8, 5},  /* Down between the clamps. */
    {40, 8, 5},  /* The cutter would pass below the left strap, the nose would not. */
    {44, 8, 5},  /* Not as far. */
    {44, 8, 60}, /* Up. */
    {20, 8, 60}, /* Over the left clamp. */
    {20, 8, 33}, /* Down on it, to 2 above. */
    {20, 8, 32}, /* To 1 above: neither clear nor not, so it is refused. */
    {90, 8, 33}, /* Over both clamps. */
};

static msw_scratch_entry scratch[CLAMPS_SCRATCH_ENTRIES];
CLAMPS_CHECK_SCRATCH(scratch);

static msw_model clamps;

/* Lowers `until` to the part of a move, of 1, before which a convex part of the head is clear. */
static int32_t clear_until(const float (*corners)[3], uint32_t count, float radius,
                           const float from[3], const float to[3], float *until)
{
    float begin[8][3], end[8][3];
    for (uint32_t corner = 0; corner < count; corner++) {
        for (int axis = 0; axis < 3; axis++) {
            begin[corner][axis] = corners[corner][axis] + from[axis];
            end[corner][axis] = corners[corner][axis] + to[axis];
        }
    }
    msw_hit found;
    const int32_t error = msw_solid_first_contact(&clamps, begin[0], end[0], count, radius + KEEP, NULL,
                                            scratch, CLAMPS_SCRATCH_ENTRIES, &found);
    /* A proof is infinite. After an error t.lower is 0. */
    if (found.t.lower < *until) {
        *until = found.t.lower;
    }
    return error;
}

/* The same of the whole head: 2 if all of the move is proved clear. */
static int32_t head_clear_until(const float from[3], const float to[3], float *until)
{
    *until = 2.0f;
    int32_t error = clear_until(cutter, 2, CUTTER_RADIUS, from, to, until);
    if (error == MSW_OK) {
        error = clear_until(nose, 8, 0.0f, from, to, until);
    }
    return error;
}

static int32_t run(void)
{
    int32_t error = msw_open(&clamps, clamps_bytes, CLAMPS_BYTES);
    /* Moves are asked about surfaces. So the head must begin outside of the clamps, and clear. The
     * head is connected: where it is clear, the side of one point is the side of all. */
    msw_signed side;
    float until = 0;
    if (error == MSW_OK) {
        error = msw_signed_distance(&clamps, start, NULL, scratch, CLAMPS_SCRATCH_ENTRIES, &side);
    }
    if (error == MSW_OK) {
        error = head_clear_until(start, start, &until);
    }
    if (error != MSW_OK) {
        return error;
    }
    const int is_fine = side.side == MSW_SIDE_OUTSIDE && until > 1.0f;
    print_line("the start is outside and clear: ", (uint32_t)is_fine, "");
    if (!is_fine) {
        return MSW_OK;
    }

    const float *place = start;
    uint32_t worst = 0;
    for (uint32_t number = 0; number < MOVES; number++) {
        const uint32_t from = clock_count();
        error = head_clear_until(place, moves[number], &until);
        if (error != MSW_OK) {
            return error;
        }
        const uint32_t took = clock_count() - from;
        worst = took > worst ? took : worst;
        if (until > 1.0f) {
            place = moves[number]; /* Here the machine moves. */
            print_line("move ", number + 1, " is made");
        } else {
            print_line("move ", number + 1, " is refused");
            print_line("  thousandths of it that are clear: ", (uint32_t)(until * 1000.0f), "");
        }
    }
    print_line("cost: the worst move took ", worst, clock_unit);
    return MSW_OK;
}

int main(void)
{
    const int32_t error = run();
    if (error != MSW_OK) {
        print(msw_strerror(error));
    }
    return error != MSW_OK;
}
