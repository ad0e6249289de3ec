/* Asks every question of the C interface about committed blobs, and prints one line for each kind:
 * its name, and a hash of all words of all answers. `host c-answers` prints the same lines from
 * Rust, without the C interface. It runs on this machine and on boards: print() is that of the
 * examples. */

#include "board.h"
#include "meshsweep.h"

#include <stddef.h>

extern const unsigned char groove[];
extern const uint32_t groove_bytes;
extern const unsigned char hulls[];
extern const uint32_t hulls_bytes;
extern const unsigned char bracket[];
extern const uint32_t bracket_bytes;
extern const unsigned char torus[];
extern const uint32_t torus_bytes;
extern const unsigned char fence[];
extern const uint32_t fence_bytes;
extern const unsigned char field[];
extern const uint32_t field_bytes;
extern const unsigned char both[];
extern const uint32_t both_bytes;
extern const unsigned char bend[];
extern const uint32_t bend_bytes;

/* Distances of two models take a board millions of instructions: fewer of them. */
enum { ROUNDS = 24, PAIR_ROUNDS = 6, SPLITS = 60, FACES = 48 };

static msw_scratch_entry scratch[MSW_DISTANCE_ENTRIES];
static msw_refined_entry refined[MSW_REFINED_ENTRIES(SPLITS)];
static msw_face faces[FACES];

static uint32_t state;
static uint32_t hash;

/* Integers times a power of two, so that no compiler can round otherwise. */
static float random_coordinate(void)
{
    state = state * 1664525u + 1013904223u;
    return (float)((int32_t)(state >> 16) - 32768) * (1.0f / 512.0f);
}

static void random_point(float point[3])
{
    for (int axis = 0; axis < 3; axis++) {
        point[axis] = random_coordinate();
    }
}

static void random_step(float place[3])
{
    float step[3];
    random_point(step);
    for (int axis = 0; axis < 3; axis++) {
        place[axis] += step[axis] * (1.0f / 1024.0f);
    }
}

static void begin(void)
{
    state = 1;
    hash = 2166136261u;
}

/* All answers are made of words. FNV-1a, a word at a time. */
static void fold(const void *answer, size_t bytes)
{
    const uint32_t *words = answer;
    for (size_t at = 0; at < bytes / 4; at++) {
        hash = (hash ^ words[at]) * 16777619u;
    }
}

static void fold_word(uint32_t word)
{
    fold(&word, sizeof word);
}

static void end(const char *kind)
{
    char line[32];
    size_t length = 0;
    for (; kind[length] != 0; length++) {
        line[length] = kind[length];
    }
    line[length++] = ' ';
    for (int digit = 0; digit < 8; digit++) {
        line[length++] = "0123456789abcdef"[hash >> (28 - 4 * digit) & 15];
    }
    line[length++] = '\n';
    line[length] = 0;
    print(line);
}

/* Exact, then with few steps, then with a tolerance and little scratch. */
static const msw_budget *budget_of(int round)
{
    static const msw_budget few = {0.0f, 0.0f, 3};
    static const msw_budget wide = {0.25f, 0.5f, 0};
    return round % 3 == 0 ? NULL : round % 3 == 1 ? &few : &wide;
}

static size_t scratch_of(int round)
{
    return round % 3 == 2 ? 6 : MSW_DISTANCE_ENTRIES;
}

static msw_pose pose_of(int round)
{
    static const msw_pose half_turn = {{{0, -1, 0}, {1, 0, 0}, {0, 0, 1}}, {0, 0, 0}, 0};
    static const msw_pose none = {{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}, {0, 0, 0}, 0};
    msw_pose pose = round % 2 ? half_turn : none;
    random_point(pose.translation);
    return pose;
}

/* Every other one mirrors. */
static msw_pose affine_of(int round)
{
    msw_pose pose = pose_of(round);
    if (round % 2) {
        pose.rotation[2][2] = -1.0f;
        pose = msw_pose_affine(pose);
    }
    return pose;
}

/* Without its work: processors with vector registers may visit nodes in another order. */
static void fold_closest(const msw_closest *answer)
{
    fold(answer, offsetof(msw_closest, work));
}

static void points(const msw_model *model)
{
    begin();
    for (int round = 0; round < ROUNDS; round++) {
        float point[3];
        random_point(point);
        msw_closest answer;
        fold_word((uint32_t)msw_closest_point(model, point, budget_of(round), scratch,
                                              scratch_of(round), &answer));
        fold_closest(&answer);
    }
    end("closest_point");

    begin();
    for (int round = 0; round < ROUNDS; round++) {
        float point[3];
        random_point(point);
        msw_signed answer;
        fold_word((uint32_t)msw_signed_distance(model, point, budget_of(round), scratch,
                                                scratch_of(round), &answer));
        fold(&answer, offsetof(msw_signed, closest));
        fold_closest(&answer.closest);
    }
    end("signed_distance");

    begin();
    for (int round = 0; round < ROUNDS; round++) {
        float point[3];
        random_point(point);
        msw_winding answer;
        fold_word((uint32_t)msw_winding_number(model, point, budget_of(round), scratch,
                                               scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end("winding_number");

    begin();
    for (int round = 0; round < ROUNDS; round++) {
        float point[3];
        random_point(point);
        msw_within_answer answer;
        fold_word((uint32_t)msw_within(model, point, 20.0f, budget_of(round), scratch,
                                       scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end("within");

    begin();
    for (int round = 0; round < ROUNDS; round++) {
        float point[3];
        random_point(point);
        msw_neighbor near[5];
        msw_nearest_answer answer;
        fold_word((uint32_t)msw_nearest(model, point, near, 5, budget_of(round), scratch,
                                        scratch_of(round), &answer));
        fold(&answer, sizeof answer);
        fold(near, answer.stored * sizeof near[0]);
    }
    end("nearest");

    /* Walks. Most answers of the second one come from what is kept. */
    msw_hint hint = {0};
    float place[3];
    begin();
    random_point(place);
    for (int round = 0; round < ROUNDS; round++) {
        random_step(place);
        msw_closest answer;
        fold_word((uint32_t)msw_closest_point_from(model, &hint, place, budget_of(round), scratch,
                                                   scratch_of(round), &answer));
        fold_closest(&answer);
    }
    end("closest_point_from");

    static msw_coherent coherent;
    begin();
    random_point(place);
    for (int round = 0; round < ROUNDS; round++) {
        random_step(place);
        msw_coherent_closest answer;
        fold_word((uint32_t)msw_coherent_closest_point(model, &coherent, place, budget_of(round),
                                                       scratch, scratch_of(round), &answer));
        fold_closest(&answer.closest);
        fold(&answer.safe_radius, sizeof answer.safe_radius);
    }
    end("coherent");
}

/* Continues a CRC-32 (ISO-HDLC). */
static uint32_t crc(uint32_t sum, const unsigned char *bytes, uint32_t count)
{
    for (; count > 0; count--) {
        sum ^= *bytes++;
        for (int bit = 0; bit < 8; bit++) {
            sum = sum >> 1 ^ (sum & 1 ? 0xedb88320u : 0);
        }
    }
    return sum;
}

static uint32_t word_at(const unsigned char *bytes)
{
    return bytes[0] | (uint32_t)bytes[1] << 8 | (uint32_t)bytes[2] << 16 | (uint32_t)bytes[3] << 24;
}

static void put_word(unsigned char *bytes, uint32_t word)
{
    for (int byte = 0; byte < 4; byte++) {
        bytes[byte] = (unsigned char)(word >> (8 * byte));
    }
}

/* Moves the groove by 16 along x. The first section is the tree's header, with the grid's origin at
 * byte 8. */
static void move_groove(unsigned char *blob)
{
    unsigned char *header = blob + word_at(blob + 164);
    put_word(header + 8, word_at(header + 8) + 16384);
    put_word(blob + 172, ~crc(~0u, header, word_at(blob + 168)));
    const uint32_t sum = crc(~0u, blob, 156);
    put_word(blob + 156, ~crc(sum, blob + 160, word_at(blob + 12) - 160));
}

/* A walk about a model that another one of as many nodes replaces, at the same address. */
static void replaced(void)
{
    static unsigned char blob[8192];
    static msw_model model;
    static msw_coherent coherent;
    begin();
    for (uint32_t byte = 0; byte < groove_bytes; byte++) {
        blob[byte] = groove[byte];
    }
    float place[3];
    random_point(place);
    for (int round = 0; round < ROUNDS; round++) {
        if (round % 8 == 0) {
            move_groove(blob);
            fold_word((uint32_t)msw_open(&model, blob, groove_bytes));
        }
        random_step(place);
        msw_coherent_closest answer;
        fold_word((uint32_t)msw_coherent_closest_point(&model, &coherent, place, NULL, scratch,
                                                       MSW_DISTANCE_ENTRIES, &answer));
        fold_closest(&answer.closest);
        fold(&answer.safe_radius, sizeof answer.safe_radius);
    }
    end("replaced");
}

static void segments(const msw_model *model)
{
    begin();
    for (int round = 0; round < ROUNDS; round++) {
        float a[3], b[3];
        random_point(a);
        random_point(b);
        msw_hit answer;
        fold_word((uint32_t)msw_first_hit(model, a, b, round % 4 == 3 ? 0 : round % 4,
                                          budget_of(round), scratch, scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end("first_hit");

    begin();
    for (int round = 0; round < ROUNDS; round++) {
        float origin[3], direction[3];
        random_point(origin);
        random_point(direction);
        msw_hit answer;
        fold_word((uint32_t)msw_first_hit_of_ray(model, origin, direction,
                                                 round % 4 == 3 ? 0 : round % 4, budget_of(round),
                                                 scratch, scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end("first_hit_of_ray");

    begin();
    for (int round = 0; round < ROUNDS; round++) {
        float corners[4][3];
        for (int corner = 0; corner < 4; corner++) {
            random_point(corners[corner]);
        }
        msw_hit answer;
        fold_word((uint32_t)msw_solid_first_contact(model, corners[0], corners[2], 2, 1.5f,
                                              budget_of(round), scratch, scratch_of(round),
                                              &answer));
        fold(&answer, sizeof answer);
    }
    end("first_contact");
}

static void two_models(const msw_model *model)
{
    begin();
    for (int round = 0; round < ROUNDS; round++) {
        const msw_pose pose = pose_of(round);
        msw_overlap_answer answer;
        fold_word((uint32_t)msw_overlap(model, model, &pose, budget_of(round), scratch,
                                        scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end("overlap");

    begin();
    for (int round = 0; round < ROUNDS; round++) {
        const msw_pose pose = affine_of(round);
        msw_within_of_answer answer;
        fold_word((uint32_t)msw_within_of(model, model, &pose, 4.0f, budget_of(round), scratch,
                                          scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end("within_of");

    begin();
    for (int round = 0; round < PAIR_ROUNDS; round++) {
        const msw_pose pose = affine_of(round);
        msw_pair_distance answer;
        fold_word((uint32_t)msw_distance(model, model, &pose, budget_of(round), scratch,
                                         scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end("distance");

    /* A walk: most answers come from what is kept. */
    static msw_coherent_pair pair;
    msw_pose walk = pose_of(0);
    begin();
    random_point(walk.translation);
    for (int round = 0; round < PAIR_ROUNDS; round++) {
        random_step(walk.translation);
        msw_pair_distance distance;
        fold_word((uint32_t)msw_coherent_pair_distance(&pair, model, model, &walk,
                                                       budget_of(round), scratch,
                                                       scratch_of(round), &distance));
        fold(&distance, sizeof distance);
        msw_within_of_answer within;
        fold_word((uint32_t)msw_coherent_pair_within(&pair, model, model, &walk, 30.0f,
                                                     budget_of(round), scratch,
                                                     scratch_of(round), &within));
        fold(&within, sizeof within);
    }
    end("coherent_pair");

    begin();
    for (int round = 0; round < PAIR_ROUNDS; round++) {
        msw_motion motion;
        motion.kind = round % 4 < 2 ? MSW_MOTION_STRAIGHT : MSW_MOTION_SCREW;
        motion.from = pose_of(round);
        motion.to = pose_of(0);
        if (motion.kind == MSW_MOTION_STRAIGHT) {
            /* One rotation: then nothing shrinks. */
            for (int row = 0; row < 3; row++) {
                for (int column = 0; column < 3; column++) {
                    motion.to.rotation[row][column] = motion.from.rotation[row][column];
                }
            }
        }
        msw_pair_contact answer;
        fold_word((uint32_t)msw_first_contact_of(model, model, &motion, 1.0f, budget_of(round),
                                                 scratch, scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end("first_contact_of");
}

/* Three copies of a model: one stands, one walks, one stands far away from time to time. */
static void scene(const msw_model *model, const char *kind)
{
    enum { MODELS = 3, PAIRS = 2 };
    static msw_scene_entry memory[MSW_SCENE_ENTRIES(MODELS, PAIRS)];
    static const msw_kept_pair pairs[PAIRS] = {{{0, 1}, 4.0f}, {{2, 1}, 8.0f}};
    const size_t count = sizeof memory / sizeof memory[0];
    begin();
    msw_placed models[MODELS];
    for (int index = 0; index < MODELS; index++) {
        models[index].model = model;
        models[index].pose = pose_of(index);
    }
    fold_word((uint32_t)msw_scene_begin(memory, count, models, MODELS, pairs, PAIRS));
    for (int round = 0; round < ROUNDS; round++) {
        random_step(models[1].pose.translation);
        fold_word((uint32_t)msw_scene_move(memory, 1, &models[1].pose));
        if (round % 8 == 7) {
            models[2].pose = pose_of(round);
            fold_word((uint32_t)msw_scene_move(memory, 2, &models[2].pose));
            models[1].pose = pose_of(round);
        }
        if (round % 16 == 15) {
            fold_word((uint32_t)msw_scene_reset(memory));
        }
        msw_scene_answer answer;
        fold_word((uint32_t)msw_scene_within(memory, budget_of(round), scratch,
                                             scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end(kind);
}

static void poses(void)
{
    begin();
    msw_rounded_pose world = {pose_of(0), 0.0f, 0.0f};
    for (int round = 0; round < ROUNDS; round++) {
        float quaternion[4] = {0, 0, 0, 1};
        float translation[3];
        random_point(quaternion);
        random_point(translation);
        msw_rounded_pose link, back, seen;
        float motion;
        fold_word((uint32_t)msw_pose_of_quaternion(quaternion, translation, &link));
        fold(&link, sizeof link);
        fold_word((uint32_t)msw_pose_then(&link, &world, &world));
        fold(&world, sizeof world);
        fold_word((uint32_t)msw_pose_inverse(&link, &back));
        fold(&back, sizeof back);
        fold_word((uint32_t)msw_pose_relative_to(&world, &link, &seen));
        fold(&seen, sizeof seen);
        fold_word((uint32_t)msw_pose_motion(&seen, 32.0f, &motion));
        fold(&motion, sizeof motion);
    }
    end("poses");
}

static void triboxes(void)
{
    static msw_triboxes part;
    static msw_node_pair pairs[16];
    begin();
    fold_word((uint32_t)msw_open_triboxes(&part, torus, torus_bytes));
    fold_word(msw_triboxes_scratch_entries(&part, &part));
    for (int round = 0; round < ROUNDS; round++) {
        msw_pose pose = pose_of(round);
        for (int axis = 0; axis < 3; axis++) {
            pose.translation[axis] *= 1.0f / 16.0f;
        }
        msw_apart_answer apart;
        fold_word((uint32_t)msw_triboxes_apart(&part, &part, &pose, budget_of(round), scratch,
                                               scratch_of(round), &apart));
        fold(&apart, sizeof apart);
        fold_word((uint32_t)msw_triboxes_within(&part, &part, &pose, 4.0f, budget_of(round),
                                                scratch, scratch_of(round), &apart));
        fold(&apart, sizeof apart);
        msw_candidates_answer found;
        fold_word((uint32_t)msw_triboxes_candidates(&part, &part, &pose, pairs, 16,
                                                    budget_of(round), scratch,
                                                    scratch_of(round), &found));
        fold(&found, sizeof found);
        for (uint32_t at = 0; at < found.stored; at++) {
            fold_word(pairs[at].a | (uint32_t)pairs[at].b << 16);
        }
        float a[3], b[3];
        random_point(a);
        random_point(b);
        msw_tribox_bound bound;
        fold_word((uint32_t)msw_triboxes_distance(&part, a, budget_of(round), scratch,
                                                  scratch_of(round), &bound));
        fold(&bound, sizeof bound);
        fold_word((uint32_t)msw_triboxes_clip(&part, a, b, budget_of(round), scratch,
                                              scratch_of(round), &bound));
        fold(&bound, sizeof bound);
    }
    end("triboxes");
}

static void fold_on_curve(const msw_curve_closest *answer)
{
    fold(answer, sizeof *answer);
}

static void curves(void)
{
    static msw_curve curve;
    begin();
    fold_word((uint32_t)msw_open_curve(&curve, fence, fence_bytes));
    fold_word(msw_curve_scratch_entries(&curve));
    fold_word((uint32_t)msw_curve_check_fence(&curve));
    for (int round = 0; round < ROUNDS; round++) {
        float point[3];
        random_point(point);
        msw_curve_closest near;
        fold_word((uint32_t)msw_curve_closest_point(&curve, point, budget_of(round), scratch,
                                                    scratch_of(round), &near));
        fold_on_curve(&near);
        msw_curve_signed sided;
        fold_word((uint32_t)msw_curve_signed_distance(&curve, point, budget_of(round), scratch,
                                                      scratch_of(round), &sided));
        fold(&sided, offsetof(msw_curve_signed, closest));
        fold_on_curve(&sided.closest);
        msw_curve_within_answer within;
        fold_word((uint32_t)msw_curve_within(&curve, point, 20.0f, budget_of(round), scratch,
                                             scratch_of(round), &within));
        fold(&within, sizeof within);
        msw_curve_neighbor neighbors[3];
        msw_nearest_answer nearest;
        fold_word((uint32_t)msw_curve_nearest(&curve, point, neighbors, 3, budget_of(round),
                                              scratch, scratch_of(round), &nearest));
        fold(&nearest, sizeof nearest);
        fold(neighbors, nearest.stored * sizeof *neighbors);
        msw_all_within_answer all;
        fold_word((uint32_t)msw_curve_all_within(&curve, point, 30.0f, neighbors, 3,
                                                 budget_of(round), scratch, scratch_of(round),
                                                 &all));
        fold(&all, sizeof all);
        fold(neighbors, all.stored * sizeof *neighbors);
    }
    end("curves");
}

static void distance_field(void)
{
    static msw_sdf sdf;
    begin();
    fold_word((uint32_t)msw_open_sdf(&sdf, field, field_bytes));
    msw_interval unit = {0.0f, 0.0f};
    fold_word((uint32_t)msw_sdf_unit(&sdf, &unit.lower));
    fold(&unit, sizeof unit);
    for (int round = 0; round < ROUNDS; round++) {
        float point[3];
        random_point(point);
        msw_sdf_answer near;
        fold_word((uint32_t)msw_sdf_distance(&sdf, point, &near));
        fold(&near, sizeof near);
        msw_sdf_gradient_answer sloped;
        fold_word((uint32_t)msw_sdf_distance_and_gradient(&sdf, point, &sloped));
        fold(&sloped, sizeof sloped);
        msw_verdict_answer within;
        fold_word((uint32_t)msw_sdf_within(&sdf, point, 8.0f, &within));
        fold(&within, sizeof within);
        int32_t place[3], gradient[3];
        fold_word((uint32_t)msw_sdf_units_of(&sdf, point, place));
        fold(place, sizeof place);
        msw_sdf_units units;
        fold_word((uint32_t)msw_sdf_distance_in_units(&sdf, place, &units));
        fold(&units, sizeof units);
        fold_word((uint32_t)msw_sdf_gradient_in_units(&sdf, place, gradient));
        fold(gradient, sizeof gradient);
    }
    end("field");
}

static void field_first(void)
{
    msw_both part;
    static const float ends[2][3] = {{20.0f, 20.0f, 50.0f}, {20.0f, 24.0f, 55.0f}};
    begin();
    fold_word((uint32_t)msw_open_both(&part, both, both_bytes));
    fold_word(msw_both_scratch_entries(&part));
    for (int round = 0; round < ROUNDS; round++) {
        float point[3];
        random_point(point);
        msw_within_answer within;
        fold_word((uint32_t)msw_both_within(&part, point, 8.0f, budget_of(round), scratch,
                                            scratch_of(round), &within));
        fold(&within, sizeof within);
        const msw_budget coarse = {0.1f, 2.0f, UINT32_MAX};
        msw_bounds_answer bounds;
        fold_word((uint32_t)msw_both_distance(&part, point, &coarse, scratch, scratch_of(round),
                                              &bounds));
        fold(&bounds, sizeof bounds);
        msw_signed_bounds_answer signed_bounds;
        fold_word((uint32_t)msw_both_signed_distance(&part, point, &coarse, scratch,
                                                     scratch_of(round), &signed_bounds));
        fold(&signed_bounds, sizeof signed_bounds);
        msw_closest near;
        fold_word((uint32_t)msw_both_closest_point(&part, point, &coarse, scratch,
                                                   scratch_of(round), &near));
        fold_closest(&near);
        msw_hit met;
        float moved[2][3];
        for (int axis = 0; axis < 3; axis++) {
            moved[0][axis] = point[axis];
            moved[1][axis] = point[axis] + 4.0f;
        }
        fold_word((uint32_t)msw_both_solid_first_contact(&part, ends[0], moved[0], 2, 0.5f,
                                                         budget_of(round), scratch,
                                                         scratch_of(round), &met));
        fold(&met, sizeof met);
    }
    end("field_first");
}

static void tight_hull(void)
{
    static msw_tight hull;
    begin();
    for (uint32_t index = 0; index < 2; index++) {
        fold_word((uint32_t)msw_open_tight(&hull, hulls, hulls_bytes,
                                           index == 1 ? MSW_FINEST : 0));
        fold_word(msw_tight_scratch_entries(&hull));
        for (int round = 0; round < ROUNDS; round++) {
            float point[3];
            random_point(point);
            msw_within_answer answer;
            fold_word((uint32_t)msw_tight_within(&hull, point, 20.0f, budget_of(round), scratch,
                                                 scratch_of(round), &answer));
            fold(&answer, sizeof answer);
        }
    }
    end("tight_within");

    static msw_model surface;
    begin();
    fold_word((uint32_t)msw_tight_model(&surface, &hull));
    for (int round = 0; round < ROUNDS; round++) {
        const msw_pose pose = pose_of(round);
        msw_within_of_answer answer;
        fold_word((uint32_t)msw_within_of(&surface, &surface, &pose, 4.0f, budget_of(round),
                                          scratch, scratch_of(round), &answer));
        fold(&answer, sizeof answer);
    }
    end("tight_models");
}

static void refined_hull(void)
{
    static msw_hull hull;
    begin();
    fold_word((uint32_t)msw_open_hull(&hull, bracket, bracket_bytes));
    for (int32_t kind = 0; kind < 10; kind++) {
        msw_focus focus = {0};
        focus.kind = kind % 5;
        random_point(focus.a);
        random_point(focus.b);
        focus.radius = 3.0f;
        focus.cosine = 0.5f;
        focus.error_per_distance = 0.125f;
        msw_refinement answer;
        fold_word((uint32_t)msw_refine(&hull, refined, MSW_REFINED_ENTRIES(SPLITS), &focus,
                                       0.5f, &answer));
        fold(&answer, sizeof answer);
        msw_faces_answer written;
        fold_word((uint32_t)msw_refined_faces(&hull, refined, MSW_REFINED_ENTRIES(SPLITS), faces,
                                              FACES, &written));
        fold(&written, sizeof written);
        fold(faces, written.stored * sizeof faces[0]);
    }
    for (int round = 0; round < 3; round++) {
        float point[3];
        random_point(point);
        msw_refinement answer;
        fold_word((uint32_t)msw_refine_swept(&hull, refined, MSW_REFINED_ENTRIES(SPLITS), point,
                                             4.0f, &answer));
        fold(&answer, sizeof answer);
    }
    end("refine");
}

/* What sweeps hold, and places of vertices. */
enum { KEPT = 512, RECORDS = 512, VERTICES = 256 };

static msw_scratch_entry kept[KEPT];
static msw_moved_vertex records[2][RECORDS];
static float vertices[VERTICES][3];

/* A point near a mesh of about one unit. */
static void near_point(float point[3])
{
    random_point(point);
    for (int axis = 0; axis < 3; axis++) {
        point[axis] *= 1.0f / 32.0f;
    }
}

static void random_vertices(uint32_t count)
{
    for (uint32_t vertex = 0; vertex < count && vertex < VERTICES; vertex++) {
        random_point(vertices[vertex]);
        for (int axis = 0; axis < 3; axis++) {
            vertices[vertex][axis] *= 1.0f / 64.0f;
        }
    }
}

static void fold_hit(const msw_hit *answer)
{
    fold(answer, offsetof(msw_hit, work));
}

static void sweeps(void)
{
    static msw_hull hull;
    static msw_sweep sweep;
    float place[3];
    msw_closest near;
    begin();
    fold_word((uint32_t)msw_open_hull(&hull, bracket, bracket_bytes));
    fold_word(msw_hull_sweep_entries(&hull));
    random_point(place);
    fold_word((uint32_t)msw_sweep_begin(&sweep, &hull, place, kept, KEPT));
    for (int round = 0; round < ROUNDS; round++) {
        if (round % 8 == 7) {
            random_point(place);
        } else {
            random_step(place);
        }
        fold_word((uint32_t)msw_sweep_move_to(&sweep, place));
        fold_word((uint32_t)msw_sweep_closest_point(&sweep, budget_of(round), &near));
        fold_closest(&near);
        for (int rank = 0; rank < 2; rank++) {
            fold_word((uint32_t)msw_sweep_next(&sweep, NULL, &near));
            fold_closest(&near);
        }
    }
    end("sweep");
}

static void key_frames(void)
{
    static msw_deform deform;
    static msw_hull hull;
    static msw_frame_sweep sweep;
    float place[3], a[3], b[3];
    msw_closest near;
    msw_hit hit;
    begin();
    fold_word((uint32_t)msw_open_deform(&deform, bend, bend_bytes));
    fold_word(msw_deform_scratch_entries(&deform));
    fold_word(msw_deform_frames(&deform));
    fold_word(msw_deform_vertices(&deform));
    fold_word(msw_deform_records(&deform));
    fold_word((uint32_t)msw_deform_hull(&hull, &deform));
    fold_word(msw_hull_sweep_entries(&hull));
    near_point(place);
    fold_word((uint32_t)msw_frame_sweep_begin(&sweep, &deform, 0.0f, place, kept, KEPT));
    const size_t count = msw_deform_scratch_entries(&deform);
    for (int round = 0; round < ROUNDS; round++) {
        const float frame = (float)(round % 9) * 0.125f;
        near_point(a);
        near_point(b);
        fold_word((uint32_t)msw_frame_closest_point(&deform, frame, a, budget_of(round), scratch,
                                                    count, &near));
        fold_closest(&near);
        fold_word((uint32_t)msw_frame_first_hit(&deform, frame, a, b, budget_of(round), scratch,
                                                count, &hit));
        fold_hit(&hit);
        fold_word((uint32_t)msw_frame_sweep_to(&sweep, frame));
        random_step(place);
        fold_word((uint32_t)msw_frame_sweep_move_to(&sweep, place));
        fold_word((uint32_t)msw_frame_sweep_closest_point(&sweep, budget_of(round), &near));
        fold_closest(&near);
        for (int rank = 0; rank < 2; rank++) {
            fold_word((uint32_t)msw_frame_sweep_next(&sweep, NULL, &near));
            fold_closest(&near);
        }
    }
    end("frames");
}

static void moved_vertices(void)
{
    static msw_deform deform;
    static msw_moved moved;
    static msw_moved_sweep sweep;
    float place[3], a[3], b[3];
    msw_closest near;
    msw_hit hit;
    begin();
    fold_word((uint32_t)msw_open_deform(&deform, bend, bend_bytes));
    fold_word((uint32_t)msw_moved_begin(&moved, &deform, records[0], RECORDS));
    near_point(place);
    fold_word((uint32_t)msw_moved_sweep_begin(&sweep, &deform, records[1], RECORDS, place, kept,
                                              KEPT));
    const size_t count = msw_deform_scratch_entries(&deform);
    const uint32_t vertex_count = msw_deform_vertices(&deform);
    for (int round = 0; round < ROUNDS; round++) {
        random_vertices(vertex_count);
        const float slack = (float)(round % 3) * 0.25f;
        const float(*places)[3] = (const float(*)[3])vertices;
        near_point(a);
        near_point(b);
        fold_word((uint32_t)msw_moved_update(&moved, slack, places, vertex_count));
        fold_word((uint32_t)msw_moved_closest_point(&moved, a, budget_of(round), scratch, count,
                                                    &near));
        fold_closest(&near);
        fold_word((uint32_t)msw_moved_first_hit(&moved, a, b, budget_of(round), scratch, count,
                                                &hit));
        fold_hit(&hit);
        fold_word((uint32_t)msw_moved_sweep_update(&sweep, slack, places, vertex_count));
        random_step(place);
        fold_word((uint32_t)msw_moved_sweep_move_to(&sweep, place));
        fold_word((uint32_t)msw_moved_sweep_closest_point(&sweep, budget_of(round), &near));
        fold_closest(&near);
        for (int rank = 0; rank < 2; rank++) {
            fold_word((uint32_t)msw_moved_sweep_next(&sweep, NULL, &near));
            fold_closest(&near);
        }
    }
    end("moved");
}

/* What is refused, and that the answer is zeroed. */
static void refusals(const msw_model *model)
{
    static const float point[3] = {1, 2, 3};
    static const msw_model never_opened;
    static const msw_pose zeros;
    static msw_model damaged;
    float not_a_number[3] = {1, 2, 3};
    uint32_t nan_bits = 0x7fc00000u;
    for (size_t byte = 0; byte < sizeof nan_bits; byte++) {
        ((unsigned char *)&not_a_number[2])[byte] = ((const unsigned char *)&nan_bits)[byte];
    }
    msw_closest answer;
    msw_hit hit;
    msw_coherent_closest moving;
    msw_overlap_answer overlap;
    msw_refinement refinement;
    const size_t count = MSW_DISTANCE_ENTRIES;

    begin();
    fold_word((uint32_t)msw_closest_point(NULL, point, NULL, scratch, count, &answer));
    fold_word((uint32_t)msw_closest_point(model, NULL, NULL, scratch, count, &answer));
    fold_word((uint32_t)msw_closest_point(model, point, NULL, NULL, count, &answer));
    fold_word((uint32_t)msw_closest_point(model, point, NULL, scratch, count, NULL));
    const uintptr_t odd = (uintptr_t)point + 1;
    fold_word((uint32_t)msw_closest_point(model, (const float *)odd, NULL, scratch, count,
                                          &answer));
    fold_word((uint32_t)msw_closest_point(&never_opened, point, NULL, scratch, count, &answer));
    fold_word((uint32_t)msw_closest_point(model, point, NULL, NULL, 0, &answer));
    fold_word((uint32_t)msw_closest_point(model, point, NULL, scratch, SIZE_MAX / 2, &answer));
    fold_word((uint32_t)msw_closest_point(model, not_a_number, NULL, scratch, count, &answer));
    fold(&answer, sizeof answer);
    fold_word((uint32_t)msw_first_hit(model, point, point, 3, NULL, scratch, count, &hit));
    fold_word((uint32_t)msw_overlap(model, model, &zeros, NULL, scratch, count, &overlap));
    fold_word((uint32_t)msw_solid_first_contact(model, NULL, NULL, 0, 1.0f, NULL, scratch, count, &hit));
    fold_word((uint32_t)msw_solid_first_contact(model, point, point, 1, -1.0f, NULL, scratch, count,
                                          &hit));
    fold_word((uint32_t)msw_coherent_closest_point(model, NULL, point, NULL, scratch, count,
                                                   &moving));
    fold_word((uint32_t)msw_closest_point_from(model, NULL, point, NULL, scratch, count, &answer));
    fold_word((uint32_t)msw_open(&damaged, groove, 100));
    fold_word((uint32_t)msw_closest_point(&damaged, point, NULL, scratch, count, &answer));
    fold_word((uint32_t)msw_open(&damaged, hulls, hulls_bytes));
    fold_word((uint32_t)msw_open(&damaged, groove + 1, 400));
    static msw_tight tight;
    fold_word((uint32_t)msw_tight_model(&damaged, &tight));
    fold_word((uint32_t)msw_open_tight(&tight, hulls, hulls_bytes, 2));
    static msw_hull hull;
    fold_word((uint32_t)msw_open_hull(&hull, bracket, bracket_bytes));
    /* It was used with another count. */
    fold_word((uint32_t)msw_refine(&hull, refined, 7, NULL, 1.0f, &refinement));
    fold_word((uint32_t)msw_refine(&hull, refined, 1, NULL, 1.0f, &refinement));
    /* Scenes: too few entries, no such model, one twice, a distance below 0, a pose of zeros, memory
     * without a scene, then with one; begun anew in too many entries, and in too few. */
    static msw_scene_entry memory[MSW_SCENE_ENTRIES(2, 1)];
    static const msw_kept_pair wrong[3] = {{{0, 2}, 1.0f}, {{1, 1}, 1.0f}, {{0, 1}, -1.0f}};
    static const msw_kept_pair right = {{0, 1}, 1.0f};
    const size_t entries = MSW_SCENE_ENTRIES(2, 1);
    msw_placed models[2] = {{model, pose_of(0)}, {model, pose_of(0)}};
    msw_scene_answer near;
    fold_word((uint32_t)msw_scene_begin(memory, entries - 1, models, 2, &right, 1));
    for (int index = 0; index < 3; index++) {
        fold_word((uint32_t)msw_scene_begin(memory, entries, models, 2, &wrong[index], 1));
    }
    models[1].pose = zeros;
    fold_word((uint32_t)msw_scene_begin(memory, entries, models, 2, &right, 1));
    fold_word((uint32_t)msw_scene_within(memory, NULL, scratch, count, &near));
    models[1].pose = pose_of(1);
    fold_word((uint32_t)msw_scene_begin(memory, entries, models, 2, &right, 1));
    fold_word((uint32_t)msw_scene_move(memory, 2, &models[1].pose));
    fold_word((uint32_t)msw_scene_move(memory, 1, &zeros));
    fold_word((uint32_t)msw_scene_within(memory, NULL, scratch, 0, &near));
    fold(&near, sizeof near);
    static const size_t bad_counts[2] = {SIZE_MAX, 1};
    for (int index = 0; index < 2; index++) {
        fold_word((uint32_t)msw_scene_begin(memory, entries, models, 2, &right, 1));
        fold_word((uint32_t)msw_scene_begin(memory, bad_counts[index], models, 2, &right, 1));
        fold_word((uint32_t)msw_scene_within(memory, NULL, scratch, count, &near));
    }
    /* A kind of motion, and a motion of zeros. */
    msw_motion motion = {2, pose_of(0), pose_of(0)};
    msw_pair_contact contact;
    fold_word((uint32_t)msw_first_contact_of(model, model, &motion, 1.0f, NULL, scratch, count,
                                             &contact));
    static const msw_motion unmoved;
    fold_word((uint32_t)msw_first_contact_of(model, model, &unmoved, 1.0f, NULL, scratch, count,
                                             &contact));
    fold(&contact, sizeof contact);
    static msw_triboxes bounds;
    fold_word((uint32_t)msw_open_triboxes(&bounds, groove, groove_bytes));
    fold_word(msw_triboxes_scratch_entries(&bounds, &bounds));
    static msw_triboxes part;
    msw_apart_answer apart;
    fold_word((uint32_t)msw_open_triboxes(&part, torus, torus_bytes));
    fold_word((uint32_t)msw_triboxes_within(&part, &part, NULL, -1.0f, NULL, scratch, count,
                                            &apart));
    fold(&apart, sizeof apart);
    static msw_curve curve;
    fold_word((uint32_t)msw_open_curve(&curve, groove, groove_bytes));
    fold_word((uint32_t)msw_curve_check_fence(&curve));
    static msw_sdf sdf;
    msw_sdf_units units;
    fold_word((uint32_t)msw_open_sdf(&sdf, groove, groove_bytes));
    fold_word((uint32_t)msw_sdf_distance_in_units(&sdf, NULL, &units));
    fold(&units, sizeof units);
    /* Of a mesh that deforms: no such frame, a blob without one, nothing begun, too few records,
     * too few vertices, a vertex that is no number, and the question after it. */
    static msw_deform deform;
    static msw_moved moved;
    static msw_sweep sweep;
    static float vertices_of[VERTICES][3];
    const float(*places)[3] = (const float(*)[3])vertices_of;
    fold_word((uint32_t)msw_open_deform(&deform, bend, bend_bytes));
    const uint32_t vertex_count = msw_deform_vertices(&deform);
    fold_word((uint32_t)msw_frame_closest_point(&deform, 9.0f, point, NULL, scratch, count,
                                                &answer));
    fold(&answer, sizeof answer);
    fold_word((uint32_t)msw_sweep_closest_point(&sweep, NULL, &answer));
    fold_word((uint32_t)msw_moved_closest_point(&moved, point, NULL, scratch, count, &answer));
    fold_word((uint32_t)msw_moved_begin(&moved, &deform, records[0], 1));
    fold_word((uint32_t)msw_moved_begin(&moved, &deform, records[0], RECORDS));
    fold_word((uint32_t)msw_moved_update(&moved, 0.0f, places, vertex_count - 1));
    fold_word((uint32_t)msw_moved_update(&moved, -1.0f, places, vertex_count));
    vertices_of[0][0] = not_a_number[2];
    fold_word((uint32_t)msw_moved_update(&moved, 0.0f, places, vertex_count));
    fold_word((uint32_t)msw_moved_closest_point(&moved, point, NULL, scratch, count, &answer));
    fold_word((uint32_t)msw_open_deform(&deform, groove, groove_bytes));
    fold_word((uint32_t)msw_moved_begin(&moved, &deform, records[0], RECORDS));
    end("refusals");
}

int main(void)
{
    static msw_model model, trusted;
    uint32_t checksum;
    begin();
    fold_word((uint32_t)msw_open(&model, groove, groove_bytes));
    fold_word((uint32_t)msw_open_trusted(&trusted, groove, groove_bytes));
    fold_word((uint32_t)msw_checksum(groove, groove_bytes, &checksum));
    fold_word(checksum);
    fold_word(msw_scratch_entries(&model));
    fold_word(msw_version());
    fold_word(msw_format_version() >> 16);
    end("open");
    points(&trusted);
    replaced();
    segments(&model);
    two_models(&model);
    scene(&model, "scene");
    poses();
    triboxes();
    curves();
    distance_field();
    field_first();
    tight_hull();
    refined_hull();
    sweeps();
    key_frames();
    moved_vertices();
    refusals(&model);
    return 0;
}
