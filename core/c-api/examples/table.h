/* The blob `table.msw` of `table.obj`.
 *
 * Written by `meshsweep build --emit c`, for version 0.1.0 of the library. Compile table.c
 * with your program. Give table_bytes to an open function of meshsweep.h.
 *
 * Bytes of the processor's stack that a function takes in libmeshsweep_small.a /
 * libmeshsweep.a. Of the functions for this blob, those that are not listed take less
 * than 64.
 *                               
 *   msw_open                    
 *   msw_open_trusted            
 *   msw_first_hit               
 *   msw_overlap                 
 *   msw_within_of               
 *   msw_distance                
 *   msw_coherent_pair_distance  
 *   msw_coherent_pair_within    
 *   msw_first_contact_of        
 *   msw_scene_begin             
 *   msw_scene_move              
 *   msw_scene_within            
 *   msw_solid_first_contact     
 *   msw_checksum                
 *   msw_pose_of_quaternion      
 *   msw_pose_then               
 *   msw_pose_inverse            
 *   msw_pose_relative_to        
 *   msw_pose_motion             
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
