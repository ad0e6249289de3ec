/* An arm guards itself 1,000 times a second: seven links, a table and a machine, 21 pairs, each
 * with a distance to keep. It stops before the machine. The same program in Rust:
 * core/examples/guard.
 *
 * A tick computes where the links are, tells the scene, and asks. What the links may be off by is
 * in the distances. link.h, link.c, table.h and table.c are by
 * `meshsweep build link.obj -o link.msw --for segment --emit c`; the machine is groove.c.
 */

#include "board.h"
#include "groove.h"
#include "link.h"
#include "meshsweep.h"
#include "table.h"

#define KEEP_LINKS 5.0f   /* distance to keep of two links, mm */
#define KEEP_AROUND 10.0f /* of a link from what stands around */
/* No point of a link is farther than this from the place that is computed, mm. Each tick checks
 * it. */
#define MOST_OFF 0.25f
/* No point of a link moves farther in a tick, mm. So the distances are kept between ticks too. */
#define MOST_PER_TICK 0.5f
/* Pairs of nodes that a tick may open: what bounds its time. With fewer it stops too early. */
#define STEPS 2000

#define LENGTH 60.0f  /* from axis to axis of a link, mm */
#define RADIUS 67.0f  /* a link is within this of its first axis, mm */
#define ENCODER 1e-4f /* what an encoder of 16 bits does not tell, rad */

enum { TICKS = 1200, LINKS = 7, TABLE = 7, MACHINE = 8, MODELS = 9, PAIRS = 21 };

/* Two links. Of a link and the next but one joints of 90 degrees keep the distance. */
#define BETWEEN(a, b) {{a, b}, KEEP_LINKS + 2.0f * (MOST_OFF + MOST_PER_TICK)}
/* A link and what does not move. */
#define AROUND(a, b) {{a, b}, KEEP_AROUND + MOST_OFF + MOST_PER_TICK}

static const msw_kept_pair pairs[PAIRS] = {
    BETWEEN(0, 3),      BETWEEN(0, 4),      BETWEEN(0, 5),      BETWEEN(0, 6),
    BETWEEN(1, 4),      BETWEEN(1, 5),      BETWEEN(1, 6),      BETWEEN(2, 5),
    BETWEEN(2, 6),      BETWEEN(3, 6),      AROUND(1, TABLE),   AROUND(2, TABLE),
    AROUND(3, TABLE),   AROUND(4, TABLE),   AROUND(5, TABLE),   AROUND(6, TABLE),
    AROUND(2, MACHINE), AROUND(3, MACHINE), AROUND(4, MACHINE), AROUND(5, MACHINE),
    AROUND(6, MACHINE),
};

static msw_model link, table, machine;
static msw_scene_entry guard[MSW_SCENE_ENTRIES(MODELS, PAIRS)];
static msw_scratch_entry scratch[MSW_DISTANCE_ENTRIES];
static msw_rounded_pose places[LINKS]; /* from each link's frame to the world */

/* Turned about y by twice the angle of this tangent, then moved along x. */
static int32_t turned(float half, float along, msw_rounded_pose *answer)
{
    const float quaternion[4] = {0, half, 0, 1};
    const float translation[3] = {along, 0, 0};
    return msw_pose_of_quaternion(quaternion, translation, answer);
}

/* Where the links are. Each pose knows how far it may be off: by rounding and by the encoders. */
static int32_t place(uint32_t tick)
{
    /* Tangents of half the joints' angles at the start, and 65,536ths more each tick. So no sine is
     * needed. */
    static const float start[LINKS - 1] = {0.0f, 0.05f, 0.05f, 0.1f, 0.1f, 0.1f};
    static const uint32_t per_tick[LINKS - 1] = {13, 13, 13, 7, 13, 7};
    int32_t error = turned(-1.0f, 0.0f, &places[0]); /* the base points up */
    for (int joint = 0; joint < LINKS - 1 && error == MSW_OK; joint++) {
        msw_rounded_pose at;
        const float half = (float)(per_tick[joint] * tick) / 65536.0f;
        error = turned(start[joint] + half, LENGTH, &at);
        at.turn += ENCODER;
        if (error == MSW_OK) {
            error = msw_pose_then(&at, &places[joint], &places[joint + 1]);
        }
    }
    return error;
}

/* Whether the distances allow for what the links may be off by. */
static int is_near_enough(void)
{
    for (int index = 0; index < LINKS; index++) {
        float off;
        if (msw_pose_motion(&places[index], RADIUS, &off) != MSW_OK || !(off <= MOST_OFF)) {
            return 0;
        }
    }
    return 1;
}

static int32_t begin(void)
{
    int32_t error = msw_open_trusted(&link, link_bytes, LINK_BYTES);
    if (error == MSW_OK) {
        error = msw_open_trusted(&table, table_bytes, TABLE_BYTES);
    }
    if (error == MSW_OK) {
        error = msw_open_trusted(&machine, groove_bytes, GROOVE_BYTES);
    }
    if (error == MSW_OK) {
        error = place(0);
    }
    if (error != MSW_OK) {
        return error;
    }
    static msw_placed models[MODELS] = {
        [TABLE] = {&table, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {-100, -100, -28}, 0}},
        [MACHINE] = {&machine, {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {210, -16, -8}, 0}},
    };
    for (int index = 0; index < LINKS; index++) {
        models[index].model = &link;
        models[index].pose = places[index].pose;
    }
    return msw_scene_begin(guard, MSW_SCENE_ENTRIES(MODELS, PAIRS), models, MODELS, pairs, PAIRS);
}

/* One tick. */
static int32_t ask(msw_scene_answer *near)
{
    static const msw_budget budget = {.steps = STEPS};
    for (uint32_t index = 0; index < LINKS; index++) {
        const int32_t error = msw_scene_move(guard, index, &places[index].pose);
        if (error != MSW_OK) {
            return error;
        }
    }
    return msw_scene_within(guard, &budget, scratch, MSW_DISTANCE_ENTRIES, near);
}

static int32_t run(void)
{
    static msw_scene_answer near;
    int32_t error = begin();
    uint32_t sum = 0, most = 0, most_before = 0, ticks = 0;
    for (uint32_t tick = 0; tick < TICKS && error == MSW_OK; tick++) {
        uint32_t from = clock_count();
        error = place(tick);
        const uint32_t before = clock_count() - from;
        if (error == MSW_OK && !is_near_enough()) {
            print("the links are farther off than the distances allow for\n");
            break;
        }
        from = clock_count();
        if (error == MSW_OK) {
            error = ask(&near);
        }
        const uint32_t took = clock_count() - from;
        ticks++;
        sum += took;
        most = took > most ? took : most;
        most_before = before > most_before ? before : most_before;
        if (error == MSW_OK && !msw_is_clear(near.verdict)) {
            print_line("stopped before tick ", tick, "");
            if (near.models[0] != MSW_NO_MODEL) {
                print_line("  model ", near.models[0], "");
                print_line("  and model ", near.models[1], " may be too near");
            }
            break;
        }
        /* Here the arm moves. */
    }
    if (error != MSW_OK) {
        return error;
    }
    print_line("cost: a tick takes ", sum / (ticks == 0 ? 1 : ticks), clock_unit);
    print_line("cost: the costliest tick takes ", most, clock_unit);
    print_line("cost: places of the links take ", most_before, clock_unit);
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
