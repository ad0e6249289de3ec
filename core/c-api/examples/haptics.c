/* A fingertip feels a part: a force pushes it out where it is inside. The same program in Rust:
 * core/examples/haptics.
 *
 * The tip moves in small steps. A coherent query keeps what earlier answers ruled out, and gives
 * the bits of a fresh query for less work. This program asks both, to show the difference.
 *
 * A pad over the part pushes before the tip is inside. It is asked at each tick of a faster loop:
 * a distance field gives the distance and the direction of the push, for a look-up.
 */

#include "board.h"
#include "groove.h"
#include "groove_pad.h"
#include "meshsweep.h"

/* Without sides no force would push the finger out. */
#if !GROOVE_HAS_SIDES
#error "the part has no sides"
#endif

#define STEP 0.015625f   /* length of a step, mm */
#define STIFFNESS 500.0f /* mN for a mm */
#define PAD 1.0f         /* thickness of the pad, mm; the margin of its field is three times that */
#define SOFTNESS 100.0f  /* mN for a mm into the pad */

/* From 1 above the top, which is at 30, to half a mm inside, along it over the slot, and out. */
static const float start[3] = {8, 20, 31};
enum { LEGS = 3 };
static const struct {
    float step[3];
    uint32_t count;
} legs[LEGS] = {{{0, 0, -STEP}, 96}, {{STEP, 0, 0}, 1024}, {{0, 0, STEP}, 96}};

static msw_scratch_entry scratch[GROOVE_SCRATCH_ENTRIES];
GROOVE_CHECK_SCRATCH(scratch);

static msw_model part;
static msw_coherent moving; /* Zeros: it begins anew. */
static msw_sdf pad;

static int is_same(const msw_closest *a, const msw_closest *b)
{
    int same = a->distance.lower == b->distance.lower && a->distance.upper == b->distance.upper;
    for (int axis = 0; axis < 3; axis++) {
        same = same && a->point[axis] == b->point[axis];
    }
    return same;
}

static int32_t run(void)
{
    int32_t error = msw_open(&part, groove_bytes, GROOVE_BYTES);
    if (error == MSW_OK) {
        error = msw_open_sdf(&pad, groove_pad_bytes, GROOVE_PAD_BYTES);
    }
    float finger[3] = {start[0], start[1], start[2]};
    float largest = 0;
    int is_inside = 0;
    uint32_t questions = 0, same = 0, boxes = 0, triangles = 0, cost = 0;
    uint32_t fresh_boxes = 0, fresh_triangles = 0, fresh_cost = 0, pad_cost = 0, agree = 0;
    float push = 0;
    for (uint32_t at = 0, leg = 0; leg < LEGS && error == MSW_OK;) {
        for (int axis = 0; axis < 3; axis++) {
            finger[axis] += legs[leg].step[axis];
        }
        msw_coherent_closest answer;
        uint32_t from = clock_count();
        error = msw_coherent_closest_point(&part, &moving, finger, NULL, scratch,
                                           GROOVE_SCRATCH_ENTRIES, &answer);
        cost += clock_count() - from;
        const msw_closest near = answer.closest;
        /* Farther than some steps from the surface the finger is on the side where it was. */
        if (error == MSW_OK && near.distance.lower <= 4.0f * STEP) {
            msw_signed found;
            error = msw_signed_distance(&part, finger, NULL, scratch, GROOVE_SCRATCH_ENTRIES,
                                        &found);
            if (found.side != MSW_SIDE_UNDECIDED) { /* Undecided: as before. */
                is_inside = found.side == MSW_SIDE_INSIDE;
            }
        }
        const float force = is_inside ? STIFFNESS * near.distance.lower : 0.0f;
        largest = force > largest ? force : largest;

        if (error == MSW_OK) {
            msw_sdf_gradient_answer felt;
            from = clock_count();
            error = msw_sdf_distance_and_gradient(&pad, finger, &felt);
            pad_cost += clock_count() - from;
            const msw_interval range = felt.found.distance;
            const float out = range.lower > 0 ? range.lower : 0.0f;
            const float depth = out < PAD ? PAD - out : 0.0f;
            const float up = SOFTNESS * depth * felt.gradient[2];
            push = up > push ? up : push;
            const float low = is_inside ? -near.distance.upper : near.distance.lower;
            const float high = is_inside ? -near.distance.lower : near.distance.upper;
            agree += range.lower <= high && low <= range.upper;
        }

        if (error == MSW_OK) {
            msw_closest fresh;
            from = clock_count();
            error = msw_closest_point(&part, finger, NULL, scratch, GROOVE_SCRATCH_ENTRIES, &fresh);
            fresh_cost += clock_count() - from;
            questions++;
            same += (uint32_t)is_same(&near, &fresh);
            boxes += near.work.bounds;
            triangles += near.work.triangles;
            fresh_boxes += fresh.work.bounds;
            fresh_triangles += fresh.work.triangles;
        }
        at++;
        if (at == legs[leg].count) {
            at = 0;
            leg++;
        }
    }
    if (error != MSW_OK) {
        return error;
    }
    print_line("questions: ", questions, "");
    print_line("answers with the bits of a fresh query: ", same, "");
    print_line("largest force: ", (uint32_t)largest, " mN");
    print_line("intervals of the field that share a distance with the tree's: ", agree, "");
    print_line("largest push of the pad upwards: ", (uint32_t)push, " mN");
    print_line("boxes tested: ", boxes, "");
    print_line("triangles tested: ", triangles, "");
    print_line("cost: fresh queries tested ", fresh_boxes, " boxes");
    print_line("cost: and ", fresh_triangles, " triangles");
    print_line("cost: a question took ", cost / questions, clock_unit);
    print_line("cost: a fresh one took ", fresh_cost / questions, clock_unit);
    print_line("cost: one of the field took ", pad_cost / questions, clock_unit);
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
