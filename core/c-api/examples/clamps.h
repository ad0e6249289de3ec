/* The blob `clamps.msw` of `clamps.obj`.
 *
 * Written by `meshsweep build --emit c`, for version 0.1.0 of the library. Compile clamps.c
 * with your program. Give clamps_bytes to an open function of meshsweep.h.
 *
 * Bytes of the processor's stack that a question takes in libmeshsweep_small.a /
 * libmeshsweep.a, without the frame of its msw_ function:
 *                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
 *   open a box tree                 2560 / 2240    2624 / 2304    2560 / 2240    2496 / 2240
 *   closest point                   1408 / 1344    2240 / 2112    1408 / 1344    2048 / 1856
 *   closest point from a hint       1344 / 1280    2240 / 2112    1344 / 1280    2048 / 1856
 *   coherent query                  1856 / 1728    2816 / 2624    1856 / 1728    2560 / 2368
 *   closest points                  3072 / 3008    3968 / 3904    3072 / 3008    3712 / 3520
 *   within                          2048 / 1920    2944 / 2816    2048 / 1920    2688 / 2496
 *   nearest triangles               1856 / 1856    2816 / 2688    1856 / 1792    2560 / 2432
 *   all within                      1856 / 1856    2880 / 2752    1856 / 1856    2560 / 2432
 *   signed distance                 3712 / 3840    4480 / 4544    3712 / 3840    4288 / 4224
 *   first hit                       1792 / 1280    2112 / 1792    1792 / 1280    1792 / 1536
 *   any hit                         1728 / 1216    1920 / 1664    1728 / 1216    1728 / 1408
 *   all hits                        1856 / 1344    2048 / 1728    1856 / 1344    1856 / 1600
 *   overlap                         6592 / 6144    6464 / 5952    6592 / 6144    6016 / 5696
 *   distance of two models        10112 / 10432   9984 / 10048  10112 / 10432    9216 / 9472
 *   coherent pair                 12032 / 12544  11968 / 12288  12032 / 12544  11264 / 11712
 *   scene                         10816 / 11904  10688 / 11648  10816 / 11904   9984 / 11136
 *   distance of a solid           12928 / 11264  12864 / 11136  12928 / 11328  12352 / 10560
 *   first contact                 11200 / 10560  11072 / 10304  11200 / 10624   10752 / 9856
 */
#ifndef CLAMPS_MSW_H
#define CLAMPS_MSW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define CLAMPS_BYTES 918u /* of the blob */
#define CLAMPS_CHECKSUM 0x6afe8f34u /* by msw_checksum; covers all sections */
#define CLAMPS_TRIANGLES 40u /* of the mesh */
#define CLAMPS_SCRATCH_ENTRIES 13u /* no question about a point or a segment needs more */
#define CLAMPS_IS_CLOSED 1 /* whether distances have signs */
#define CLAMPS_SURFACE_ERROR 0.0f /* most distance of the mesh from the stored surface */
#define CLAMPS_BOX_LOW {0.0f, 0.0f, 0.0f} /* of a box that contains the mesh */
#define CLAMPS_BOX_HIGH {100.0f, 16.0f, 28.0f} /* of a box that contains the mesh */

/* The blob; it begins at a multiple of four. */
extern const uint8_t clamps_bytes[CLAMPS_BYTES];

/* Does not compile if a question about a point or a segment could run out of entries.
 * msw_overlap and msw_models_within need MSW_OVERLAP_ENTRIES and MSW_DISTANCE_ENTRIES. */
#ifdef __cplusplus
#define CLAMPS_CHECK_SCRATCH(array) \
    static_assert(sizeof(array) / sizeof((array)[0]) >= CLAMPS_SCRATCH_ENTRIES, \
        "too few scratch entries for clamps")
#else
#define CLAMPS_CHECK_SCRATCH(array) \
    _Static_assert(sizeof(array) / sizeof((array)[0]) >= CLAMPS_SCRATCH_ENTRIES, \
        "too few scratch entries for clamps")
#endif

#ifdef __cplusplus
}
#endif

#endif
