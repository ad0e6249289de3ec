/* The blob `table.msw` of `table.obj`.
 *
 * Written by `meshsweep build --emit c`, for version 0.1.0 of the library. Compile table.c
 * with your program. Give table_bytes to an open function of meshsweep.h.
 *
 * Bytes of the processor's stack that a function takes in libmeshsweep_small.a /
 * libmeshsweep.a. Of the functions for this blob, those that are not listed take less
 * than 64.
 *                                    Cortex-M4F      Cortex-M0     Cortex-M33       RV32IMAC
 *   msw_open                        2496 / 2048    2560 / 2112    2496 / 2048    2368 / 1984
 *   msw_open_trusted                1280 / 1024    1280 / 1088    1280 / 1024     1152 / 960
 *   msw_first_hit                   1280 / 1344    1664 / 1728    1280 / 1344    1600 / 1536
 *   msw_first_hit_of_ray            1280 / 1280    1664 / 1664    1280 / 1280    1600 / 1472
 *   msw_overlap                     6720 / 6144    6656 / 5952    6720 / 6144    6208 / 5632
 *   msw_within_of                  10112 / 9600    9984 / 9664   10112 / 9600    9536 / 9216
 *   msw_distance                    9728 / 9216    9600 / 9216    9728 / 9216    9216 / 8768
 *   msw_coherent_pair_distance    11136 / 10944  11072 / 10944  11136 / 10944  10816 / 10816
 *   msw_coherent_pair_within      11456 / 11008  11328 / 11072  11456 / 11008  10880 / 10816
 *   msw_first_contact_of           10816 / 9920   10688 / 9920   10816 / 9920   10176 / 9408
 *   msw_scene_begin                 2048 / 1920    2240 / 2048    2048 / 1920    2048 / 1920
 *   msw_scene_move                  1088 / 1024    1280 / 1152    1088 / 1024     1152 / 960
 *   msw_scene_within              11136 / 10496  11456 / 10816  11136 / 10496  10880 / 10240
 *   msw_solid_first_contact       10688 / 10112   10624 / 9792  10688 / 10112   10176 / 9408
 *   msw_checksum                     1088 / 896     1088 / 960     1088 / 896      960 / 832
 *   msw_pose_of_quaternion            192 / 256      320 / 448      192 / 256      192 / 320
 *   msw_pose_then                     640 / 512      832 / 832      640 / 512      704 / 768
 *   msw_pose_inverse                  576 / 448      768 / 768      576 / 448      640 / 640
 *   msw_pose_relative_to              640 / 448      768 / 768      640 / 448      704 / 704
 *   msw_pose_motion                   128 / 128      192 / 192      128 / 128      128 / 128
 */
#ifndef TABLE_MSW_H
#define TABLE_MSW_H

#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

#define TABLE_BYTES 570u /* of the blob */
#define TABLE_CHECKSUM 0xc74974c5u /* by msw_checksum; covers all sections */
#define TABLE_TRIANGLES 12u /* of the mesh */
#define TABLE_SCRATCH_ENTRIES 9u /* no question about a point or a segment needs more */
#define TABLE_IS_CLOSED 1 /* whether the mesh is closed */
#define TABLE_HAS_SIDES 1 /* whether msw_signed_distance decides sides */
#define TABLE_SURFACE_ERROR 0.0f /* most distance of the mesh from the stored surface */
#define TABLE_BOX_LOW {0.0f, 0.0f, 0.0f} /* of a box that contains the mesh */
#define TABLE_BOX_HIGH {600.0f, 200.0f, 20.0f} /* of a box that contains the mesh */

/* The blob; it begins at a multiple of four. */
extern const uint8_t table_bytes[TABLE_BYTES];

/* Does not compile if a question about a point or a segment could run out of entries.
 * Questions about models need MSW_OVERLAP_ENTRIES and MSW_DISTANCE_ENTRIES. */
#ifdef __cplusplus
#define TABLE_CHECK_SCRATCH(array) \
    static_assert(sizeof(array) / sizeof((array)[0]) >= TABLE_SCRATCH_ENTRIES, \
        "too few scratch entries for table")
#else
#define TABLE_CHECK_SCRATCH(array) \
    _Static_assert(sizeof(array) / sizeof((array)[0]) >= TABLE_SCRATCH_ENTRIES, \
        "too few scratch entries for table")
#endif

#ifdef __cplusplus
}
#endif

#endif
