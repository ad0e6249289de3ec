/* How far is the tip of a probe from a part? The same file runs here and on a Cortex-M4F.
 *
 * The part is a block of 40 by 40 by 30 with a slot. groove.h and groove.c hold its blob, by
 * `meshsweep build groove.obj -o groove.msw --emit c`.
 */

#include "groove.h"
#include "meshsweep.h"

/* Prints a line. host.c has one, cortex-m4/startup.c another. */
void print(const char *text);

/* So many entries are always enough. Fewer do not compile. */
static msw_scratch_entry scratch[GROOVE_SCRATCH_ENTRIES];
GROOVE_CHECK_SCRATCH(scratch);

static msw_model part;

/* Whether the probe has to stop. Anything but a proof that the part is farther says so. */
static int must_stop(const float tip[3], float clearance)
{
    const msw_budget bounded = {.steps = 64}; /* so many nodes at most: a bounded time */
    msw_within_answer near;
    int32_t error = msw_within(&part, tip, clearance, &bounded, scratch,
                               GROOVE_SCRATCH_ENTRIES, &near);
    return error != MSW_OK || !msw_is_clear(near.verdict);
}

int main(void)
{
    /* Checks every byte. If something else guards the flash, msw_open_trusted is quicker. */
    int32_t error = msw_open(&part, groove_bytes, GROOVE_BYTES);
    if (error != MSW_OK) {
        print(msw_strerror(error));
        return 1;
    }

    /* On the way down to the slot. */
    float tip[3] = {20.0f, 20.0f, 60.0f};
    while (!must_stop(tip, 2.0f) && tip[2] > 0.0f) {
        tip[2] -= 0.25f;
    }

    msw_closest near;
    error = msw_closest_point(&part, tip, NULL, scratch, GROOVE_SCRATCH_ENTRIES, &near);
    if (error != MSW_OK) {
        print(msw_strerror(error));
        return 1;
    }
    /* One step of 0.25 before, the part was proved farther than 2. Now it is 1.75 away at least. */
    if (near.distance.lower > 2.0f || near.distance.upper < 1.75f) {
        print("the probe stopped elsewhere");
        return 1;
    }
    print("the probe stopped 2 above the part");
    return 0;
}
