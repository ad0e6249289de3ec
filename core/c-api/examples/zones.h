/* The blob `zones.msw` of `zones.csv`.
 *
 * Written by `meshsweep build --emit c`, for version 0.1.0 of the library. Compile zones.c
 * with your program. Give zones_bytes to an open function of meshsweep.h.
 *
 * Bytes of the processor's stack that a function takes in libmeshsweep_small.a /
 * libmeshsweep.a. Of the functions for this blob, those that are not listed take less
 * than 64.
 *                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
 *   msw_open_curve                  1856 / 1728    1920 / 1856    1856 / 1728    1792 / 1600
 *   msw_curve_closest_point         2048 / 1920    2048 / 1856    2112 / 1920    1792 / 1664
 *   msw_curve_within                1280 / 1280    1280 / 1280    1280 / 1280    1088 / 1088
 *   msw_curve_nearest               1536 / 1536    1536 / 1472    1536 / 1536    1280 / 1280
 *   msw_curve_all_within            1536 / 1536    1536 / 1472    1536 / 1536    1280 / 1280
 *   msw_curve_signed_distance       2432 / 2304    2368 / 2240    2432 / 2304    2112 / 1984
 *   msw_checksum                     1088 / 896     1088 / 960     1088 / 896      960 / 832
 *   msw_pose_of_quaternion            192 / 256      320 / 448      192 / 256      192 / 320
 *   msw_pose_then                     640 / 512      832 / 832      640 / 512      704 / 768
 *   msw_pose_inverse                  576 / 448      768 / 768      576 / 448      640 / 640
 *   msw_pose_relative_to              640 / 448      768 / 768      640 / 448      704 / 704
 *   msw_pose_motion                   128 / 128      192 / 192      128 / 128      128 / 128
 */
#ifndef ZONES_MSW_H
#define ZONES_MSW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define ZONES_BYTES 1215u /* of the blob */
#define ZONES_CHECKSUM 0xb55acd75u /* by msw_checksum; covers all sections */
#define ZONES_SCRATCH_ENTRIES 9u /* no question about a point or a segment needs more */
#define ZONES_IS_FENCE 1 /* whether msw_curve_signed_distance answers */

/* The blob; it begins at a multiple of four. */
extern const uint8_t zones_bytes[ZONES_BYTES];

/* Does not compile if a question about a point or a segment could run out of entries.
 * Questions about models need MSW_OVERLAP_ENTRIES and MSW_DISTANCE_ENTRIES. */
#ifdef __cplusplus
#define ZONES_CHECK_SCRATCH(array) \
    static_assert(sizeof(array) / sizeof((array)[0]) >= ZONES_SCRATCH_ENTRIES, \
        "too few scratch entries for zones")
#else
#define ZONES_CHECK_SCRATCH(array) \
    _Static_assert(sizeof(array) / sizeof((array)[0]) >= ZONES_SCRATCH_ENTRIES, \
        "too few scratch entries for zones")
#endif

#ifdef __cplusplus
}
#endif

#endif
