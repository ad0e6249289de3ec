/* meshsweep: geometric questions about triangle meshes, answered where there is no heap.
 *
 * A host tool (`meshsweep build part.stl -o part.msw`) turns a mesh into a blob. These functions
 * read the blob where it lies, in flash or in a mapped file. They allocate nothing, they do not
 * recurse, they keep no state, and they call nothing outside of the library. Any number of threads
 * may ask at once, each with its own scratch memory.
 *
 * Units and frame. Coordinates and lengths are those of the mesh file, in the mesh's frame.
 *
 * Answers. A function returns 0 (MSW_OK) or a negative MSW_ERROR_..., which msw_strerror explains.
 * After an error the answer holds zeros, if its pointer is valid. Every question may return
 * MSW_ERROR_NULL, _ALIGNMENT, _NOT_OPENED, _COUNT, _NOT_FINITE, _TOLERANCE, _OUT_OF_DOMAIN,
 * _NO_SCRATCH, _NOT_SERVED and _INTERNAL; a function's own text names others. A distance is an
 * interval that contains the true distance to the input mesh: lower and upper are rounded outwards.
 * A verdict, a side or a distance of zeros reads as "nothing is proved": MSW_UNDECIDED, or 0.
 * Numbers, points and counts of zeros mean nothing: look at the returned code. For collision
 * avoidance treat MSW_UNDECIDED as MSW_YES; msw_is_clear does that.
 *
 * Memory. All of it is the caller's. Memory that a call writes (scratch, answers, models that are
 * opened) overlaps no other argument. NULL and misaligned pointers are refused with an error. A
 * count that is larger than its array cannot be noticed.
 *
 * Scratch. Working memory of a question; its contents mean nothing between questions.
 * msw_scratch_entries tells how many entries are always enough. With fewer, at least one, the
 * search may end early: the answer still holds and says MSW_ENDED_SCRATCH.
 *
 * Budget. NULL, or a structure of zeros: search until the answer is exact; a winding number, until
 * the side is decided. A step opens a node of
 * the hierarchy. A limit of steps bounds the time of a question, and the answer still holds.
 *
 * The same blob and question give the same bits on x86-64, Cortex-M and RISC-V. Intervals hold and
 * bits are equal if the processor rounds to nearest and keeps subnormal numbers. Both are so at
 * start. Do not link with -ffast-math, nor set flush-to-zero or another rounding mode.
 */
#ifndef MESHSWEEP_H
#define MESHSWEEP_H

#include <stddef.h>
#include <stdint.h>

#ifdef __cplusplus
extern "C" {
#endif

/* The version of this header: major << 16 | minor << 8 | patch. Compare it with msw_version(). */
#define MSW_VERSION 0x000100u

/* ---- Constants. Answers hold them as int32_t, so that their size depends on no option. ---- */

/* What functions return. */
enum {
    MSW_OK = 0,
    MSW_ERROR_NULL = -1,            /* a pointer is NULL */
    MSW_ERROR_ALIGNMENT = -2,       /* a pointer is not aligned for its type */
    MSW_ERROR_NOT_OPENED = -3,      /* the model was not opened, or its open function failed */
    MSW_ERROR_COUNT = -4,           /* a count is larger than memory or a limit; no corner; too few
                                       vertices of a mesh that deforms */
    MSW_ERROR_VALUE = -5,           /* a facing or a kind is no constant of this header */
    MSW_ERROR_MEMORY = -6,          /* of a refined hull, see msw_refine; too few of a scene, or of
                                       a moved hull */
    MSW_ERROR_NO_SUCH_HULL = -7,    /* the blob has no tight hull of this number */
    /* Of the open functions: */
    MSW_ERROR_TRUNCATED = -20,      /* the blob is cut short */
    MSW_ERROR_TRAILING_BYTES = -21, /* more bytes than the blob's header announces */
    MSW_ERROR_NOT_A_BLOB = -22,     /* other bytes */
    MSW_ERROR_VERSION = -23,        /* another major version of the format */
    MSW_ERROR_CRC = -24,            /* the blob is damaged */
    MSW_ERROR_MALFORMED = -25,      /* the blob's bytes contradict each other */
    MSW_ERROR_MISSING_SECTION = -26,/* the blob was built without this structure */
    /* Of questions: */
    MSW_ERROR_NOT_FINITE = -40,     /* a coordinate is NaN or infinite */
    MSW_ERROR_TOLERANCE = -41,      /* a tolerance, distance or radius is negative, NaN, infinite */
    MSW_ERROR_OUT_OF_DOMAIN = -42,  /* a point, end or model is too far: clip segments first */
    MSW_ERROR_POSE = -43,           /* a pose is no rotation (all zeros, for one), or too large */
    MSW_ERROR_NO_SCRATCH = -44,     /* the scratch memory has no entries */
    MSW_ERROR_NOT_SERVED = -45,     /* the blob lacks the sections of this question: build --for */
    MSW_ERROR_INTERNAL = -46,       /* the bytes of the blob changed, or a fault of the library */
    MSW_ERROR_NO_MODEL = -47,       /* a scene lacks a named model, or a pair names one twice */
    MSW_ERROR_NOT_PLANAR = -48,     /* a curve's points differ in z, so it bounds no area */
    MSW_ERROR_OPEN_POLYLINE = -49,  /* a polyline is not closed, so it bounds no area */
    MSW_ERROR_NO_FRAME = -50,       /* a key frame is not in the blob */
    MSW_ERROR_NO_POSE = -51,        /* the last update of the vertices was refused */
    MSW_ERROR_NO_DIRECTION = -52    /* the direction of a ray is zero */
};

/* Verdicts. MSW_YES and MSW_NO are proved. `!verdict` is not "no": compare, or use msw_is_clear. */
enum { MSW_UNDECIDED = 0, MSW_YES = 1, MSW_NO = 2 };

/* Sides of a closed mesh. Inside and outside are proved. Of a fence inside means allowed. */
enum { MSW_SIDE_UNDECIDED = 0, MSW_SIDE_INSIDE = 1, MSW_SIDE_OUTSIDE = 2 };

/* Why a verdict or a side is undecided. */
enum {
    MSW_REASON_NOT_ASKED = 0,  /* zeros: no question was answered */
    MSW_REASON_DECIDED = 1,    /* it is decided */
    MSW_REASON_STEPS = 2,      /* the steps of the budget were used up */
    MSW_REASON_SCRATCH = 3,    /* the scratch memory was too short */
    MSW_REASON_RESOLUTION = 4, /* nearer than the stored precision and rounding can tell */
    MSW_REASON_OPEN_MESH = 5,  /* no side: the mesh is not closed, or its winding inconsistent */
    MSW_REASON_ON_SURFACE = 6, /* the point is too near to the surface for a side */
    MSW_REASON_FEATURE = 7     /* the closest features disagree, or have no certain normal */
};

/* Why a search ended. The interval holds with every reason. */
enum {
    MSW_ENDED_NOT_ASKED = 0,  /* zeros: no question was answered */
    MSW_ENDED_EXACT = 1,      /* complete: as narrow as the stored surface allows */
    MSW_ENDED_TOLERANCE = 2,  /* the tolerance of the budget was met */
    MSW_ENDED_STEPS = 3,      /* the steps of the budget were used up */
    MSW_ENDED_SCRATCH = 4,    /* the scratch memory was too short */
    MSW_ENDED_RESOLUTION = 5  /* stored precision or rounding leaves it undecided */
};

/* Which sides of triangles a segment hits. From its front a triangle's corners run
 * counter-clockwise, in the order of the input file. */
enum { MSW_FACING_BOTH = 0, MSW_FACING_FRONT = 1, MSW_FACING_BACK = 2 };

/* Where a hull is refined. */
enum {
    MSW_FOCUS_EVERYWHERE = 0, /* on the whole hull; no other field counts */
    MSW_FOCUS_BALL = 1,       /* within `radius` of `a` */
    MSW_FOCUS_BOX = 2,        /* in the box of the corners `a` and `b` */
    MSW_FOCUS_SEGMENT = 3,    /* within `radius` of the segment from `a` to `b` */
    MSW_FOCUS_EYE = 4         /* seen from `a` along `b`, see msw_focus */
};

/* How a model moves, see msw_motion. */
enum { MSW_MOTION_STRAIGHT = 0, MSW_MOTION_SCREW = 1 };

#define MSW_NO_TRIANGLE UINT32_MAX /* in the place of a triangle's number: there is none */
#define MSW_NO_NODE UINT32_MAX     /* in the place of a node of triboxes: there is none */
#define MSW_NO_MODEL UINT32_MAX    /* in the place of a model's index: there is none */
#define MSW_NO_SEGMENT UINT32_MAX  /* in the place of a polyline and its segment: there is none */
#define MSW_FINEST UINT32_MAX      /* for msw_open_tight: the tightest hull */
#define MSW_MOST_CORNERS 32        /* of a solid, for msw_solid_first_contact */
#define MSW_OVERLAP_ENTRIES 256    /* scratch entries that are always enough for msw_overlap */
#define MSW_DISTANCE_ENTRIES 384   /* the same for all others about models, see there */

/* ---- Memory of the caller ---- */

#if UINTPTR_MAX > 0xFFFFFFFFu
#define MSW_MODEL_WORDS 36
#define MSW_TIGHT_WORDS 44
#define MSW_HULL_WORDS 48
#define MSW_COHERENT_WORDS 256
#define MSW_TRIBOXES_WORDS 16
#define MSW_CURVE_WORDS 24
#define MSW_SDF_WORDS 18
#define MSW_BOTH_WORDS 54
#define MSW_DEFORM_WORDS 56
#define MSW_SCENE_MODEL_ENTRIES 56
#else
#define MSW_MODEL_WORDS 52
#define MSW_TIGHT_WORDS 60
#define MSW_HULL_WORDS 64
#define MSW_COHERENT_WORDS 480
#define MSW_TRIBOXES_WORDS 20
#define MSW_CURVE_WORDS 40
#define MSW_SDF_WORDS 28
#define MSW_BOTH_WORDS 80
#define MSW_DEFORM_WORDS 72
#define MSW_SCENE_MODEL_ENTRIES 88
#endif
#define MSW_COHERENT_PAIR_WORDS 664
#define MSW_SWEEP_WORDS 128
#define MSW_FRAME_SWEEP_WORDS 168
#define MSW_MOVED_WORDS 72
#define MSW_MOVED_SWEEP_WORDS 144

/* An opened box tree, an opened tight hull, an opened hull hierarchy, opened triboxes, opened
 * curves, an opened distance field, an opened box tree with a distance field, an opened hull
 * hierarchy that deforms. They point into the blob, which must stay where it is, unchanged, as long
 * as they are used. Copies are as good. A storage of zeros is not opened, and every question about
 * it is refused. */
typedef struct { uintptr_t opaque[MSW_MODEL_WORDS]; } msw_model;
typedef struct { uintptr_t opaque[MSW_TIGHT_WORDS]; } msw_tight;
typedef struct { uintptr_t opaque[MSW_HULL_WORDS]; } msw_hull;
typedef struct { uintptr_t opaque[MSW_TRIBOXES_WORDS]; } msw_triboxes;
typedef struct { uintptr_t opaque[MSW_CURVE_WORDS]; } msw_curve;
typedef struct { uintptr_t opaque[MSW_SDF_WORDS]; } msw_sdf;
typedef struct { uintptr_t opaque[MSW_BOTH_WORDS]; } msw_both;
typedef struct { uintptr_t opaque[MSW_DEFORM_WORDS]; } msw_deform;

/* What a query that moves keeps between calls. Zero it before the first call, or to start anew. It
 * belongs to one model at a time, and points to nothing. */
typedef struct { uintptr_t opaque[MSW_COHERENT_WORDS]; } msw_coherent;

/* The same of two models that move: up to 256 groups of pairs of boxes. Zero it before the first
 * call, or to start anew. */
typedef struct { uint64_t opaque[MSW_COHERENT_PAIR_WORDS]; } msw_coherent_pair;

/* A word of the memory of a scene that remembers, and how many words hold a scene. It points into
 * the models' blobs. Copies are as good. After msw_scene_begin returned an error, and of zeros,
 * there is no scene, and its functions return MSW_ERROR_NOT_OPENED. */
typedef struct { uintptr_t opaque; } msw_scene_entry;
#define MSW_SCENE_ENTRIES(models, pairs) \
    (5 + (models) * MSW_SCENE_MODEL_ENTRIES \
     + ((pairs) * 24 + sizeof(uintptr_t) - 1) / sizeof(uintptr_t))

/* A hull whose vertices the caller moves, and sweeps that are kept: of a hull at rest, at key
 * frames, with moved vertices. A function begins each. It points into the blob and to the arrays
 * that it was begun with. Both must stay where they are, and the arrays are used by nobody else, as
 * long as it is asked. Memory of zeros is not begun, and every question about it is refused. */
typedef struct { uint64_t opaque[MSW_MOVED_WORDS]; } msw_moved;
typedef struct { uint64_t opaque[MSW_SWEEP_WORDS]; } msw_sweep;
typedef struct { uint64_t opaque[MSW_FRAME_SWEEP_WORDS]; } msw_frame_sweep;
typedef struct { uint64_t opaque[MSW_MOVED_SWEEP_WORDS]; } msw_moved_sweep;

/* Sixteen bytes of a moved hull's memory: one vertex of one level. Need not be initialised. */
typedef struct { uint32_t opaque[4]; } msw_moved_vertex;

/* Where the last closest point was found. Zeros are no hint. Any contents are safe, of another
 * model too: a bad hint costs a leaf. */
typedef struct { uint32_t opaque; } msw_hint;

/* Eight bytes of working memory. Need not be initialised. */
typedef struct { uint32_t opaque[2]; } msw_scratch_entry;

/* Sixteen bytes of a refined hull's memory, and how many hold a hull of so many splits. A hull of
 * f faces needs (f - faces of the coarsest hull) / 2 splits. */
typedef struct { uintptr_t opaque[16 / sizeof(uintptr_t)]; } msw_refined_entry;
#define MSW_REFINED_ENTRIES(splits) ((splits) + 2)

/* ---- Arguments ---- */

/* When a question may end before its answer is exact. Tolerances are not negative. */
typedef struct {
    float relative; /* end when upper <= lower * (1 + relative) */
    float absolute; /* end when upper - lower <= absolute */
    uint32_t steps; /* end after so many nodes were opened; 0: no limit */
} msw_budget;

/* A motion: rotation * p + translation; each row of the matrix gives a coordinate. Questions refuse
 * a matrix that is no rotation, up to three decimals, by MSW_ERROR_POSE: all zeros, for one. Of an
 * affine pose they take any matrix whose entries are at most 2, see msw_pose_affine. */
typedef struct {
    float rotation[3][3];
    float translation[3];
    uint32_t is_affine; /* 1: the matrix may scale, mirror or shear. All else: it is a rotation */
} msw_pose;

/* A pose that was computed, or is known up to something. The matrix is off by a factor of lengths
 * (about radians) of at most `turn`, the translation by at most `shift`; 0 and 0 is exact. */
typedef struct {
    msw_pose pose;
    float turn;
    float shift;
} msw_rounded_pose;

/* A model at its place: from the model's frame to the world. A model may stand in several. */
typedef struct {
    const msw_model *model;
    msw_pose pose;
} msw_placed;

/* Two models of a scene, and the distance that their surfaces are to keep. */
typedef struct {
    uint32_t models[2]; /* indices into the models */
    float distance;     /* in the unit of the world */
} msw_kept_pair;

/* How a model moves from one pose to another, in the time from 0 to 1. MSW_MOTION_STRAIGHT: each
 * point goes along a straight line at a steady pace, so with two rotations the model shrinks on the
 * way. MSW_MOTION_SCREW: the model stays rigid, turns about a fixed axis by half a turn at most,
 * and goes along it. */
typedef struct {
    int32_t kind; /* MSW_MOTION_... */
    msw_pose from;
    msw_pose to;
} msw_motion;

/* Where msw_refine refines. Of an eye: `b` is the middle of the view, of any length; `cosine` that
 * of half the cone's opening angle; `error_per_distance` the error that is allowed at distance 1.
 */
typedef struct {
    int32_t kind; /* MSW_FOCUS_... */
    float a[3];
    float b[3];
    float radius;
    float cosine;
    float error_per_distance;
} msw_focus;

/* ---- Answers ---- */

/* The true value lies in lower ..= upper. */
typedef struct {
    float lower;
    float upper;
} msw_interval;

/* The work of a question. The numbers are the same on every target, but for an exact closest
 * point: processors with vector registers visit nodes in another order. */
typedef struct {
    uint32_t bounds;    /* boxes tested */
    uint32_t triangles; /* triangles tested in float */
    uint32_t exact;     /* triangles tested in double */
    uint32_t opened;    /* nodes opened: the steps of a budget. Of hulls: splits */
} msw_work;

typedef struct {
    msw_interval distance; /* to the input mesh, without sign */
    float point[3];        /* of the surface, at most distance.upper away; rounded to float */
    uint32_t triangle;     /* which holds `point`, by its number in the input file */
    int32_t ended;         /* MSW_ENDED_... */
    msw_work work;
} msw_closest;

typedef struct {
    msw_closest closest; /* the answer of msw_closest_point, but for the work */
    float safe_radius;   /* a query within it has the same closest triangle; 0: unknown */
} msw_coherent_closest;

typedef struct {
    int32_t side;          /* MSW_SIDE_... */
    int32_t reason;        /* MSW_REASON_... */
    msw_interval distance; /* negative inside; if the side is undecided, from -upper to upper */
    msw_closest closest;   /* the closest point; work and ended are those of the whole search */
} msw_signed;

typedef struct {
    msw_interval number; /* the winding number of the input file's triangles */
    int32_t side;        /* MSW_SIDE_...: inside above 1/2, outside below */
    int32_t reason;      /* MSW_REASON_... */
    int32_t ended;       /* MSW_ENDED_... */
    msw_work work;
} msw_winding;

typedef struct {
    int32_t verdict;   /* whether the segment meets the mesh. MSW_NO: proved clear */
    int32_t ended;     /* MSW_ENDED_... */
    msw_interval t;    /* parameter of the first common point, 0 at a and 1 at b. MSW_NO: infinite.
                        * No point before t.lower lies on the mesh, whatever the verdict */
    float hit_t;       /* parameter of `point`; infinite if there is none */
    float point[3];    /* the first hit found, on the stored surface. Proved with MSW_YES only */
    uint32_t triangle; /* which holds `point`, or MSW_NO_TRIANGLE: no hit was found */
    msw_work work;
} msw_hit;

typedef struct {
    int32_t verdict;   /* MSW_NO: all of the mesh is farther. MSW_YES: a point of it is not */
    int32_t reason;    /* MSW_REASON_... */
    uint32_t triangle; /* with MSW_YES one that is not farther, else MSW_NO_TRIANGLE */
    msw_work work;
} msw_within_answer;

typedef struct {
    msw_interval distance; /* to the triangle */
    float point[3];        /* of the triangle, at most distance.upper away but for its rounding */
    uint32_t triangle;     /* its number in the input file */
} msw_neighbor;

typedef struct {
    uint32_t stored;  /* neighbors that were written */
    int32_t ended;    /* MSW_ENDED_EXACT: they are the nearest */
    float rest_lower; /* no other triangle is nearer; infinite if there is no other */
    msw_work work;
} msw_nearest_answer;

typedef struct {
    int32_t verdict;       /* MSW_YES: the surfaces meet. MSW_NO: they have no common point */
    int32_t reason;        /* MSW_REASON_... */
    uint32_t triangles[2]; /* of both models, which meet or may meet, or MSW_NO_TRIANGLE */
    msw_work work;         /* opened: pairs of nodes */
} msw_overlap_answer;

typedef struct {
    int32_t verdict;       /* MSW_NO: the surfaces are farther than asked. MSW_YES: they are not */
    int32_t reason;        /* MSW_REASON_... */
    uint32_t triangles[2]; /* of both models, that are or may be as near, or MSW_NO_TRIANGLE */
    msw_work work;         /* opened: pairs of nodes */
} msw_within_of_answer;

typedef struct {
    msw_interval distance; /* of both surfaces. 0 and 0: it is proved that they meet */
    float points[2][3];    /* of each surface, nearest to each other, in the first model's frame; at
                            * most distance.upper apart but for their rounding */
    uint32_t triangles[2]; /* which hold these points, by their numbers in the input files */
    int32_t ended;         /* MSW_ENDED_... */
    msw_work work;         /* opened: pairs of nodes */
} msw_pair_distance;

typedef struct {
    int32_t verdict;       /* MSW_NO: they keep the distance all the time. Else undecided */
    float clear_until;     /* the part of the motion before which they do; infinite: all of it */
    float points[2][3];    /* of each surface, nearest at that time, in the first model's frame */
    uint32_t triangles[2]; /* which hold these points */
    int32_t ended;         /* MSW_ENDED_EXACT: it is clear. MSW_ENDED_RESOLUTION: at clear_until the
                            * surfaces are at the distance, as far as can be told */
    msw_work work;         /* of all distances */
} msw_pair_contact;

typedef struct {
    int32_t verdict;    /* MSW_NO: all pairs keep their distance. MSW_YES: one does not */
    int32_t reason;     /* MSW_REASON_... */
    uint32_t models[2]; /* the pair too near, else the first undecided one, or MSW_NO_MODEL */
    msw_work work;      /* bounds: pairs that were looked at */
} msw_scene_answer;

/* A node of each of two hierarchies of triboxes. */
typedef struct {
    uint16_t a; /* of the first one */
    uint16_t b; /* of the second one, which is moved */
} msw_node_pair;

typedef struct {
    int32_t verdict;        /* MSW_NO: the models are apart, or farther. Else MSW_UNDECIDED */
    int32_t ended;          /* MSW_ENDED_... */
    msw_node_pair may_meet; /* the first found that may meet or be nearer; zeros with MSW_NO */
    msw_work work;          /* bounds: pairs tested. opened: pairs opened */
} msw_apart_answer;

typedef struct {
    int32_t verdict;  /* MSW_NO: the models are apart. Else MSW_UNDECIDED */
    int32_t ended;    /* MSW_ENDED_SCRATCH, _STEPS: some pairs are not of leaves */
    uint32_t stored;  /* pairs that were written */
    uint32_t dropped; /* pairs that did not fit */
    msw_work work;    /* as of msw_apart_answer */
} msw_candidates_answer;

typedef struct {
    msw_interval distance; /* to the input curve, without sign */
    float point[3];        /* of the curve, at most distance.upper away; rounded to float */
    uint32_t polyline;     /* which holds `point`, counted from 0 as in the file */
    uint32_t segment;      /* of the polyline, which begins at the point of this number, from 0 */
    float t;               /* where `point` lies on the segment: 0 at its start, 1 at its end */
    float safe_motion;     /* while the query moves less, the segment stays closest; 0: unknown */
    int32_t ended;         /* MSW_ENDED_... */
    msw_work work;         /* bounds: capsules; exact: segments in double */
} msw_curve_closest;

typedef struct {
    int32_t side;              /* MSW_SIDE_INSIDE: the fence allows the point */
    int32_t reason;            /* MSW_REASON_... */
    msw_interval distance;     /* negative inside; if the side is undecided, -upper to upper */
    msw_curve_closest closest; /* of the line; work and ended are those of the whole search */
} msw_curve_signed;

typedef struct {
    int32_t verdict;   /* MSW_NO: all of the curve is farther. MSW_YES: a point of it is not */
    int32_t reason;    /* MSW_REASON_... */
    uint32_t polyline; /* with MSW_YES that of a segment that is not farther, */
    uint32_t segment;  /* and this segment, else MSW_NO_SEGMENT in both */
    msw_work work;
} msw_curve_within_answer;

typedef struct {
    msw_interval distance; /* to the segment */
    float point[3];        /* of it, at most distance.upper away but for its rounding */
    uint32_t polyline;     /* counted from 0, as in msw_curve_closest */
    uint32_t segment;      /* of the polyline */
    float t;               /* where `point` lies on the segment */
} msw_curve_neighbor;

typedef struct {
    int32_t side;          /* MSW_SIDE_...: outside if the interval is above 0, inside below */
    int32_t reason;        /* MSW_REASON_... */
    msw_interval distance; /* signed, to the surface, or to the solid: as the field was built */
} msw_sdf_answer;

typedef struct {
    msw_sdf_answer found;
    float gradient[3]; /* in which the distance rises the most, of a length near 1; no guarantee */
} msw_sdf_gradient_answer;

typedef struct {
    int32_t lower; /* not above the distance, units of the field */
    int32_t upper; /* not below it */
} msw_sdf_units;

typedef struct {
    msw_interval distance; /* to the surface */
    int32_t ended;         /* MSW_ENDED_...: tolerance also if the field is narrow enough */
    msw_work work;         /* of the tree: none if the field answered alone */
} msw_bounds_answer;

typedef struct {
    int32_t side;          /* MSW_SIDE_... */
    int32_t reason;        /* MSW_REASON_... */
    msw_interval distance; /* signed, negative inside */
    int32_t ended;         /* as above */
    msw_work work;
} msw_signed_bounds_answer;

typedef struct {
    int32_t verdict; /* MSW_YES, MSW_NO or MSW_UNDECIDED */
    int32_t reason;  /* MSW_REASON_... */
} msw_verdict_answer;

typedef struct {
    uint32_t stored;  /* neighbors that were written */
    uint32_t certain; /* the first so many of them are certainly within the distance */
    uint32_t dropped; /* further ones that did not fit: the nearest are written */
    int32_t ended;    /* MSW_ENDED_EXACT: all others are certainly farther. Else some may miss */
    msw_work work;
} msw_all_within_answer;

typedef struct {
    float lower;   /* nothing is nearer, or met at a lesser parameter; infinite: nowhere */
    uint32_t node; /* with this bound, or MSW_NO_NODE if `lower` is infinite */
    int32_t ended; /* MSW_ENDED_SCRATCH, _STEPS: the bound may be less than that of the leaves */
    msw_work work; /* bounds: triboxes tested. opened: nodes opened */
} msw_tribox_bound;

typedef struct {
    uint32_t is_complete; /* 1: all splits that the focus needs are performed. 0: see below */
    float error_left;     /* the largest error among needed splits that did not fit; rounded up */
    uint32_t faces;       /* of the refined hull */
    uint32_t performed;   /* splits performed by this call */
    uint32_t undone;      /* splits undone by this call */
} msw_refinement;

typedef struct {
    float corners[3][3]; /* counter-clockwise seen from outside */
    float error; /* the surface that this face stands for is no farther from it; may be infinite */
} msw_face;

typedef struct {
    uint32_t stored;  /* faces that were written */
    uint32_t dropped; /* faces that did not fit */
} msw_faces_answer;

/* ---- The box tree: build --for closest,segment, which is the default ---- */

/* Opens the box tree of a blob: `count` bytes, of any alignment.
 *
 * Checks every byte that the tree's questions read, so any bytes are safe: damaged ones give an
 * error. The blob stays where it is, and `model` refers to it. After an error `model` is not
 * opened. Cost: linear in the blob; once per start. No scratch. */
int32_t msw_open(msw_model *model, const void *bytes, size_t count);

/* The same for bytes that were verified before, for example by the signature of the firmware.
 *
 * Checks header and section table, and looks at no record. If the bytes were changed since msw_open
 * accepted them, here or on the host, any answer may be wrong. No question then crashes or reads
 * outside of the bytes, and each ends, one about two models perhaps after minutes. It
 * may return MSW_ERROR_INTERNAL. msw_checksum tells whether the bytes are the verified ones.
 * Cost: some thousand instructions. No scratch. */
int32_t msw_open_trusted(msw_model *model, const void *bytes, size_t count);

/* Checks the CRCs of header, section table and sections, and stores the first, which covers the
 * others. It equals PART_CHECKSUM in a header by `meshsweep build --emit c`. A CRC finds damage,
 * but no intent. After an error `*checksum` is 0. Cost: a dozen instructions a byte. */
int32_t msw_checksum(const void *bytes, size_t count, uint32_t *checksum);

/* How many scratch entries are always enough for a question about a point or a segment.
 * `meshsweep build` prints the same number. 0 if `model` is NULL, misaligned or not opened. */
uint32_t msw_scratch_entries(const msw_model *model);

/* The closest point of the surface, with an interval that contains its distance.
 *
 * Of equidistant triangles the answer is the least in blob order. A point on the surface has
 * distance.lower 0. Farther than a million model sizes the model's box gives the interval.
 * Cost: five to fifteen nodes and three to twelve leaves on scanned parts. The worst case is the
 * whole tree, at the centre of a sphere: set budget->steps where time is bounded. */
int32_t msw_closest_point(const msw_model *model, const float point[3],
                          const msw_budget *budget,
                          msw_scratch_entry *scratch, size_t scratch_count,
                          msw_closest *answer);

/* msw_closest_point that looks at the leaf of `hint` first and leaves its own there. So a query
 * near the last one takes less work, in four bytes of memory.
 *
 * An exact answer has the same bits with every hint. With a tolerance or steps the interval holds,
 * and may be another one. After an error the hint is as before. MSW_ERROR_NULL: `hint` is NULL.
 * Cost: less than that of msw_closest_point near the last query, else a leaf more. */
int32_t msw_closest_point_from(const msw_model *model, msw_hint *hint, const float point[3],
                               const msw_budget *budget,
                               msw_scratch_entry *scratch, size_t scratch_count,
                               msw_closest *answer);

/* msw_closest_point for a query that moves: the same bits in distance, point and triangle. The less
 * it moved since the last call with `coherent`, the less work it takes.
 *
 * With another model than in the last call it starts anew. A model is told by its blob: by the
 * address and the checksum. So another blob may take the place of the first one; open it again.
 * With a tolerance in the budget it is msw_closest_point. Steps bound the search on the kept state
 * and, if that fails, the plain search after it: together at most twice as many nodes, and the
 * answer may be exact where the plain one is not. After an error the state is as before.
 * Cost: one triangle within safe_radius of the last query; one to three leaves for steps of 3e-4 of
 * the model's diagonal; that of msw_closest_point for jumps. */
int32_t msw_coherent_closest_point(const msw_model *model, msw_coherent *coherent,
                                   const float point[3],
                                   const msw_budget *budget,
                                   msw_scratch_entry *scratch, size_t scratch_count,
                                   msw_coherent_closest *answer);

/* The signed distance of a closed mesh: negative where the nearest surface has its back to the
 * point. Of the budget only `steps` matters.
 *
 * The side is never wrong. It is undecided if the mesh is not closed and consistently wound, where
 * the nearest triangle crosses another or lies inside another part of the surface (`meshsweep
 * build` says so), on the surface, next to walls thinner than the surface error and the rounding
 * (some 1e-5 of the model's size), and next to slivers without a normal.
 * Cost: one to three times that of msw_closest_point, up to four times more next to edges. */
int32_t msw_signed_distance(const msw_model *model, const float point[3],
                            const msw_budget *budget,
                            msw_scratch_entry *scratch, size_t scratch_count,
                            msw_signed *answer);

/* How often the surface encloses `point`: its generalised winding number. The mesh need not be
 * closed: the side is that of the surface as a whole. Build --for closest,winding.
 *
 * The number is nearly 1 inside and nearly 0 outside, and between them in a hole. It is that of all
 * triangles of the input file, as wound there. Components that overlap or share walls are united,
 * if they are wound alike. In a component that is inside out the number is nearly -1. The search
 * ends as soon as the side is decided and the interval is no wider than budget->absolute, a pure
 * number here; budget->relative is ignored. The side is undecided within some ten surface errors
 * of the surface, where the number is 1/2, and below -1/2. Only in a closed mesh that is proved to
 * face inwards as a whole a number below -1/2 is inside.
 * MSW_ERROR_NOT_SERVED: the blob was built without --for winding.
 * Cost: far from the mesh one node; else the nodes and triangles within a few times the distance
 * from the surface; several times as much where the side stays undecided. */
int32_t msw_winding_number(const msw_model *model, const float point[3],
                           const msw_budget *budget,
                           msw_scratch_entry *scratch, size_t scratch_count,
                           msw_winding *answer);

/* Whether the mesh is at most `distance` from `point`. Of the budget only `steps` matters.
 *
 * Distances are to the surface: deep inside a part nothing is near. A distance of 0 asks whether
 * the point touches: the answer is MSW_NO or undecided, as rounding cannot prove a contact.
 * Cost: less than that of the closest point. It ends at the first triangle that is near enough. */
int32_t msw_within(const msw_model *model, const float point[3], float distance,
                   const msw_budget *budget,
                   msw_scratch_entry *scratch, size_t scratch_count,
                   msw_within_answer *answer);

/* The first common point of the segment from `a` to `b` and the surface. `facing` is one of
 * MSW_FACING_...: back faces, or front faces, may be left out, by the input file's winding. Of the
 * budget only `steps` matters.
 *
 * MSW_NO: no point of the segment lies on the mesh. MSW_YES: it meets the mesh, and t contains the
 * parameter of the first common point. A segment in a triangle's plane, of no length, or through a
 * triangle without area may hit, and is then undecided. MSW_ERROR_OUT_OF_DOMAIN: an end is farther
 * than a million model sizes. Cost: two nodes and half a leaf on scanned parts; a segment along the
 * surface visits all boxes that it touches. */
int32_t msw_first_hit(const msw_model *model, const float a[3], const float b[3], int32_t facing,
                      const msw_budget *budget,
                      msw_scratch_entry *scratch, size_t scratch_count,
                      msw_hit *answer);

/* The first common point of a ray and the surface: of origin + t * direction, 0 <= t. The direction
 * has any length but 0 (MSW_ERROR_NO_DIRECTION), and t is in units of it.
 *
 * All else as msw_first_hit, about a segment that ends behind the model. If no hit is proved,
 * t.upper is the parameter of an end behind the model. MSW_ERROR_OUT_OF_DOMAIN: the origin is
 * farther than some 200,000 model sizes. */
int32_t msw_first_hit_of_ray(const msw_model *model, const float origin[3],
                             const float direction[3], int32_t facing,
                             const msw_budget *budget,
                             msw_scratch_entry *scratch, size_t scratch_count,
                             msw_hit *answer);

/* Where a convex solid that moves first meets the surface. The solid is all that is within `radius`
 * of the hull of its corners: one corner is a sphere, two are a capsule, eight a box. Each corner
 * goes along a straight line from its place in `from` to its place in `to`, all at a steady pace.
 * Three floats a corner: of `float corners[8][3]` pass corners[0].
 * Of the budget only `steps` matters.
 *
 * The answer is that of msw_first_hit, with the part of the motion as parameter. Before t.lower no
 * point of the solid touches the mesh at any instant. MSW_NO: none does during all of it. To keep a
 * distance, add it to the radius. Only the surface counts: a motion inside of a closed mesh may be
 * clear. If `from` and `to` are equal the answer is a contact at 0, or MSW_NO. A solid that starts
 * on the surface has a t.lower of 0. One that only touches the mesh is undecided, and so may be a
 * flat one without radius. MSW_ERROR_COUNT: no corner, or more than MSW_MOST_CORNERS.
 * Cost: the nodes that the solid passes, and one to ten distances in double for each triangle that
 * it may reach. */
int32_t msw_solid_first_contact(const msw_model *model,
                          const float *from, const float *to, size_t corner_count,
                          float radius,
                          const msw_budget *budget,
                          msw_scratch_entry *scratch, size_t scratch_count,
                          msw_hit *answer);

/* The `neighbor_count` triangles nearest to `point`, by rising distance, into `neighbors`. Of the
 * budget only `steps` matters.
 *
 * Of two triangles whose intervals overlap, the farther one may come first. If the mesh has fewer
 * triangles, all are written. After an error the contents of `neighbors` are undefined. No
 * neighbors (NULL and 0) is no error: nothing is looked at.
 * Cost: for few triangles that of the closest point, and log(neighbor_count) for each that enters.
 */
int32_t msw_nearest(const msw_model *model, const float point[3],
                    msw_neighbor *neighbors, size_t neighbor_count,
                    const msw_budget *budget,
                    msw_scratch_entry *scratch, size_t scratch_count,
                    msw_nearest_answer *answer);

/* ---- Two models: build --for segment. The second one is moved into the frame of the first ---- */

/* Whether the surface of `other`, moved by `pose` into the frame of `model`, meets the surface of
 * `model`. NULL: `other` is where it is. Of the budget only `steps` matters: pairs of nodes.
 *
 * Both verdicts are proved. Surfaces that touch without passing through each other are undecided.
 * Only surfaces count: one part may lie inside the other. Both models may be the same. If both
 * stand in a world, `pose` is that of msw_pose_relative_to.
 * MSW_OVERLAP_ENTRIES are always enough scratch. MSW_ERROR_POSE: the matrix is no
 * rotation. Cost: in proportion to the surface that is near the other model. */
int32_t msw_overlap(const msw_model *model, const msw_model *other, const msw_pose *pose,
                    const msw_budget *budget,
                    msw_scratch_entry *scratch, size_t scratch_count,
                    msw_overlap_answer *answer);

/* Whether the surface of `other`, moved by `pose` into the frame of `model`, is at most `distance`
 * from the surface of `model`. Of the budget only `steps` matters: pairs of nodes.
 *
 * Models, pose, units and errors as for msw_overlap. A distance of 0 asks whether they meet.
 * Between surfaces that are as near as `distance`, up to surface errors and rounding, it is
 * undecided. MSW_DISTANCE_ENTRIES are always enough scratch. MSW_ERROR_TOLERANCE: `distance` is
 * negative, NaN or infinite.
 * Cost on a Cortex-M4F: 500 instructions for models that are far apart, in proportion to the
 * surface that is near the other model else: hundreds of thousands a few per cent beyond
 * `distance`. Models that move: msw_scene_within. */
int32_t msw_within_of(const msw_model *model, const msw_model *other, const msw_pose *pose,
                      float distance,
                      const msw_budget *budget,
                      msw_scratch_entry *scratch, size_t scratch_count,
                      msw_within_of_answer *answer);

/* The least distance of the surface of `model` and that of `other`, moved by `pose` into its frame,
 * and where they are nearest.
 *
 * Models, pose and errors as for msw_overlap. Lengths are in the meshes' unit. Two closed meshes
 * one inside the other have the distance of their surfaces. With few steps or little scratch the
 * interval is wider. MSW_DISTANCE_ENTRIES are always enough scratch.
 * Cost: some dozens of pairs of nodes and of triangles where the nearest place is one, and in
 * proportion to the surfaces that run side by side: millions of instructions on a Cortex-M4F. Where
 * a threshold is enough, msw_within_of is much faster. */
int32_t msw_distance(const msw_model *model, const msw_model *other, const msw_pose *pose,
                     const msw_budget *budget,
                     msw_scratch_entry *scratch, size_t scratch_count,
                     msw_pair_distance *answer);

/* msw_distance of models that move: `pair` keeps what the last search left out. The less they moved
 * since the last call, the less work it takes.
 *
 * The interval holds as that of msw_distance, and its bits may differ: they depend on all calls
 * since `pair` was zeros, and are the same on every target. With other models it starts anew. If
 * they need more groups of pairs than `pair` holds, each call searches afresh. After an error the
 * memory is as before. Errors as for msw_distance; MSW_ERROR_NULL also of `pair`.
 * Cost: one pass over the groups, and the pairs of boxes that came below the distance. */
int32_t msw_coherent_pair_distance(msw_coherent_pair *pair,
                                   const msw_model *model, const msw_model *other,
                                   const msw_pose *pose,
                                   const msw_budget *budget,
                                   msw_scratch_entry *scratch, size_t scratch_count,
                                   msw_pair_distance *answer);

/* msw_within_of of models that move, in the same memory. It may follow questions about other
 * distances. Where several pairs of triangles are within, or none is decided, another one may be
 * named.
 *
 * Errors as for msw_within_of. Cost: if the motion is too short to bring the models within the
 * distance, the paths of eight corners. Many pairs of models: msw_scene_within. */
int32_t msw_coherent_pair_within(msw_coherent_pair *pair,
                                 const msw_model *model, const msw_model *other,
                                 const msw_pose *pose, float distance,
                                 const msw_budget *budget,
                                 msw_scratch_entry *scratch, size_t scratch_count,
                                 msw_within_of_answer *answer);

/* Where the surface of `other` first comes within `keep` of the surface of `model`, as `motion`
 * carries it through the frame of `model`.
 *
 * Before clear_until the surfaces are proved to be farther than `keep` apart, at every instant.
 * MSW_NO: during the whole motion. It is never MSW_YES. If both models move, the way of one as seen
 * from the other is a screw only if one of them stands still. Only surfaces count. Of the budget
 * only `steps` matters. MSW_DISTANCE_ENTRIES are always enough scratch.
 * Errors: those of msw_distance; MSW_ERROR_TOLERANCE: `keep` is negative, NaN or infinite;
 * MSW_ERROR_VALUE: an unknown kind of motion; MSW_ERROR_POSE: also an affine pose of a screw.
 * Cost: a msw_distance for each advance: three to ten where it passes at some distance, dozens
 * before contact. */
int32_t msw_first_contact_of(const msw_model *model, const msw_model *other,
                             const msw_motion *motion, float keep,
                             const msw_budget *budget,
                             msw_scratch_entry *scratch, size_t scratch_count,
                             msw_pair_contact *answer);

/* ---- A scene that remembers: models that move, and pairs that are to keep a distance ---- */

/* Begins a scene of models at their places and of the pairs that msw_scene_within asks about. Pairs
 * that are not listed, such as links that touch at a joint, are never looked at.
 *
 * `scene`: MSW_SCENE_ENTRIES(model_count, pair_count) entries, with any contents. `models` and
 * `pairs` are copied; the blobs stay where they are. After an error `scene` holds no scene, not
 * even one that was begun before, and questions refuse it by MSW_ERROR_NOT_OPENED. Without entries
 * (`scene_count` 0) nothing is written. Units: distances and translations are in the world's unit,
 * which is that of all models, as a pose does not scale. No pairs (NULL and 0) is no error.
 * Errors: MSW_ERROR_MEMORY: too few entries. MSW_ERROR_COUNT: more than memory can have.
 * MSW_ERROR_NO_MODEL: a pair names a model that is not
 * there, or one twice. MSW_ERROR_TOLERANCE: a distance is negative, NaN or infinite.
 * MSW_ERROR_POSE, MSW_ERROR_NOT_FINITE: of a pose. MSW_ERROR_NOT_OPENED: of a model.
 * MSW_ERROR_NULL, _ALIGNMENT, _COUNT: of an array.
 * Cost: 16 looks at each vertex of each model; once per start. */
int32_t msw_scene_begin(msw_scene_entry *scene, size_t scene_count,
                        const msw_placed *models, size_t model_count,
                        const msw_kept_pair *pairs, size_t pair_count);

/* Moves a model to another pose, from its frame to the world. Models that stand still need no call.
 *
 * Errors: MSW_ERROR_NO_MODEL; MSW_ERROR_POSE, MSW_ERROR_NOT_FINITE: the model stays where it was.
 * Of a matrix that changed little they may come from msw_scene_within. Cost: some 150
 * instructions. */
int32_t msw_scene_move(msw_scene_entry *scene, uint32_t model, const msw_pose *pose);

/* Whether the surfaces of any pair are at most the pair's distance apart, where the models are now.
 * Of the budget only `steps` matters, of all pairs together; each set-up of a search is one.
 *
 * Both verdicts are proved. It ends at the first pair that is too near. A distance of 0 is answered
 * by MSW_NO or undecided. Only surfaces count: one part may lie inside the other. To cover the way
 * to the next poses, add the longest path of a point of both models to the distance. The verdict is
 * that without memory, but where the budget ends a search or it is undecided for resolution. Bits
 * depend on all calls before, and are the same on every target.
 * MSW_DISTANCE_ENTRIES are always enough scratch. MSW_ERROR_NOT_SERVED: a model was built without
 * segments. MSW_ERROR_OUT_OF_DOMAIN: two models are farther from each other than float reaches.
 * Cost: one comparison a model while none went beyond its limit. Else ten operations for a pair
 * with clearance left, some hundreds for one whose boxes tell, else a search as of
 * msw_within_of. */
int32_t msw_scene_within(msw_scene_entry *scene,
                         const msw_budget *budget,
                         msw_scratch_entry *scratch, size_t scratch_count,
                         msw_scene_answer *answer);

/* Forgets all that was remembered. Models stay at their places. Only MSW_ERROR_NULL, _ALIGNMENT and
 * _NOT_OPENED. Cost: a store for each pair. */
int32_t msw_scene_reset(msw_scene_entry *scene);

/* ---- Poses: products and inverses in float, the same bits on every target ---- */

/* The same motion, whose matrix may scale, mirror or shear: questions do not ask that it is a
 * rotation. Without it a matrix that nobody filled in is refused. */
static inline msw_pose msw_pose_affine(msw_pose pose)
{
    pose.is_affine = 1;
    return pose;
}

/* The rotation of `quaternion`, x, y, z, w, then `translation`. Its length does not matter. The
 * real part is the last: some libraries write it first. MSW_ERROR_POSE: zeros. Cost: 100
 * instructions. */
int32_t msw_pose_of_quaternion(const float quaternion[4], const float translation[3],
                               msw_rounded_pose *answer);

/* The motion of `first`, then that of `next`: from a link to its parent, then from the parent to
 * the world. What both are off by is in the answer's `turn` and `shift`, and the rounding. `answer`
 * may be one of both. Cost: 200 instructions. */
int32_t msw_pose_then(const msw_rounded_pose *first, const msw_rounded_pose *next,
                      msw_rounded_pose *answer);

/* The motion back. MSW_ERROR_POSE: the matrix is no rotation, or `turn` is above a quarter. */
int32_t msw_pose_inverse(const msw_rounded_pose *pose, msw_rounded_pose *answer);

/* `pose` as seen from `frame`: its motion, then the motion back of `frame`. It is what questions
 * about two models take of models in the world. Errors: as msw_pose_inverse, of `frame`. */
int32_t msw_pose_relative_to(const msw_rounded_pose *pose, const msw_rounded_pose *frame,
                             msw_rounded_pose *answer);

/* No point of a model within `radius` of its origin is farther than `answer` from its place at the
 * exact pose. Add those of both models to the distance that is asked about. */
int32_t msw_pose_motion(const msw_rounded_pose *pose, float radius, float *answer);

/* ---- Triboxes: build --for triboxes. Bounds of 18 planes, in a few kilobytes ---- */

/* Opens the triboxes of a blob. As msw_open. */
int32_t msw_open_triboxes(msw_triboxes *triboxes, const void *bytes, size_t count);

/* How many scratch entries are always enough for a question about both, or about one. 0 if one is
 * not opened. */
uint32_t msw_triboxes_scratch_entries(const msw_triboxes *triboxes, const msw_triboxes *other);

/* Whether the models are apart, `other` moved by `pose` into the frame of `triboxes`; NULL: it is
 * where it is. Of the budget only `steps` matters: pairs of nodes opened.
 *
 * MSW_NO: the meshes have no common point, and, where both are solids, no point is in both. Else
 * the answer names the first pair of leaves that may meet. It is never MSW_YES. Units are the
 * meshes'. MSW_ERROR_POSE: the matrix is no rotation, or the translation is beyond the domain of
 * triboxes. Cost on a Cortex-M4F: 2,000 instructions, and 1,500 for each pair of nodes. */
int32_t msw_triboxes_apart(const msw_triboxes *triboxes, const msw_triboxes *other,
                           const msw_pose *pose,
                           const msw_budget *budget,
                           msw_scratch_entry *scratch, size_t scratch_count,
                           msw_apart_answer *answer);

/* Whether the models are farther from each other than `distance`, in the meshes' unit.
 *
 * MSW_NO: all points of the meshes are, and, where both are solids, those inside too. Else the
 * answer names the first pair of leaves that may be nearer. It is never MSW_YES. To cover a rounded
 * pose, add msw_pose_motion of both models. MSW_ERROR_TOLERANCE: the distance is negative, NaN or
 * infinite. Other arguments, errors and cost as for msw_triboxes_apart. */
int32_t msw_triboxes_within(const msw_triboxes *triboxes, const msw_triboxes *other,
                            const msw_pose *pose, float distance,
                            const msw_budget *budget,
                            msw_scratch_entry *scratch, size_t scratch_count,
                            msw_apart_answer *answer);

/* All pairs of leaves that may meet, into `pairs`: between all others there is no common point.
 * After an error the contents of `pairs` are undefined. NULL and 0: they are counted as dropped.
 *
 * Arguments, errors and cost as for msw_triboxes_apart. */
int32_t msw_triboxes_candidates(const msw_triboxes *triboxes, const msw_triboxes *other,
                                const msw_pose *pose,
                                msw_node_pair *pairs, size_t pair_count,
                                const msw_budget *budget,
                                msw_scratch_entry *scratch, size_t scratch_count,
                                msw_candidates_answer *answer);

/* A lower bound of the distance of `point` and the mesh or a solid's inside, in the mesh's unit. Of
 * the budget only `steps` matters. MSW_ERROR_OUT_OF_DOMAIN: a coordinate is beyond 2^120. Cost on a
 * Cortex-M4F: about a thousand instructions for each tribox tested. */
int32_t msw_triboxes_distance(const msw_triboxes *triboxes, const float point[3],
                              const msw_budget *budget,
                              msw_scratch_entry *scratch, size_t scratch_count,
                              msw_tribox_bound *answer);

/* The parameter, from 0 at `a` to 1 at `b`, before which the segment is clear of the mesh and of a
 * solid's inside. Other arguments, errors and cost as for msw_triboxes_distance. */
int32_t msw_triboxes_clip(const msw_triboxes *triboxes, const float a[3], const float b[3],
                          const msw_budget *budget,
                          msw_scratch_entry *scratch, size_t scratch_count,
                          msw_tribox_bound *answer);

/* ---- Tight hulls: build --for tight. A few kilobytes for a part of any size ---- */

/* Opens a tight hull of a blob: a closed surface of few faces that encloses the mesh. `index` 0 is
 * the coarsest, MSW_FINEST the tightest.
 *
 * The bytes may have any alignment. They stay where they are, and `hull` refers to them. Units and
 * frame are those of the mesh file. After an error `hull` is not opened.
 * Errors: those of msw_open; MSW_ERROR_MISSING_SECTION: the blob was built without --for tight;
 * MSW_ERROR_NO_SUCH_HULL: it has no more than `index` hulls.
 * Cost: every byte of all hulls is checked, linear in the blob; once per start. No scratch. */
int32_t msw_open_tight(msw_tight *hull, const void *bytes, size_t count, uint32_t index);

/* The surface of a tight hull as a model, for all questions about models.
 *
 * A body that begins outside of the hull and is clear of its surface is clear of the part inside.
 * distance.lower is then a lower bound of the distance to the part; distance.upper is none.
 * Triangles are faces of the hull. `model` refers to the blob, and no longer to `hull`. After an
 * error `model` is not opened. Cost: a copy. */
int32_t msw_tight_model(msw_model *model, const msw_tight *hull);

/* As msw_scratch_entries. */
uint32_t msw_tight_scratch_entries(const msw_tight *hull);

/* Whether the part inside the hull is at most `distance` from `point`.
 *
 * MSW_NO only outside the hull, so it holds for a solid part with its inside. Within the hull, and
 * nearer to it than it is tight, the answer is MSW_YES or undecided. There is no triangle.
 * Cost: that of msw_within about a mesh of as few faces, and inside the hull's box also that of its
 * signed distance. */
int32_t msw_tight_within(const msw_tight *hull, const float point[3], float distance,
                         const msw_budget *budget,
                         msw_scratch_entry *scratch, size_t scratch_count,
                         msw_within_answer *answer);

/* ---- Distance field: build --for sdf. One look-up: no scratch, no search ---- */

/* Opens the distance field of a blob. As msw_open. Cost: the CRC of its bytes; once per start. */
int32_t msw_open_sdf(msw_sdf *field, const void *bytes, size_t count);

/* A unit of the field, in the mesh's unit, rounded to nearest. */
int32_t msw_sdf_unit(const msw_sdf *field, float *unit);

/* Bounds of the distance of `point` (in the mesh's unit), and its side where they tell it.
 *
 * The interval contains the distance to the input mesh: signed, or of the kind of build --sdf-kind.
 * If the side of a point is not certain, it contains the distance with both signs. Outside of the
 * field the distance from the field is added. MSW_ERROR_OUT_OF_DOMAIN: farther than 2^60 units.
 * Cost on a Cortex-M4F: some 200 instructions for every point of a lattice, and more for each step
 * in a tree; on a Cortex-M0, which converts floats by calls, several times as much: see
 * msw_sdf_distance_in_units. */
int32_t msw_sdf_distance(const msw_sdf *field, const float point[3], msw_sdf_answer *answer);

/* The same, and the gradient there: the direction of a force or of a step. Outside of the field it
 * leads away from the surface. Cost: a quarter more than msw_sdf_distance on a Cortex-M4F. */
int32_t msw_sdf_distance_and_gradient(const msw_sdf *field, const float point[3],
                                      msw_sdf_gradient_answer *answer);

/* Whether the surface is at most `distance` from `point`; of a field of kind solid whether the solid
 * is, so that a point inside is never MSW_NO. Of the other kinds a point deep inside is. Undecided
 * if the interval has lengths on both sides of `distance`, or ends within two units of it: treat it
 * as MSW_YES.
 * MSW_ERROR_TOLERANCE: the distance is negative, NaN or infinite. */
int32_t msw_sdf_within(const msw_sdf *field, const float point[3], float distance,
                       msw_verdict_answer *answer);

/* Whole units nearest to `point`, from the field's least corner, as msw_sdf_distance_in_units takes
 * them. MSW_ERROR_OUT_OF_DOMAIN: outside of the field. */
int32_t msw_sdf_units_of(const msw_sdf *field, const float point[3], int32_t place[3]);

/* Bounds of the distance of a place, both in units of the field: no floating point. Above 0 the
 * place is outside, below 0 inside, unless the field is of kind surface. They hold of the place
 * itself: if a point was rounded to it, add a unit on each side. Outside of the field the bounds are
 * wider. MSW_ERROR_OUT_OF_DOMAIN: farther than 2^28 units. */
int32_t msw_sdf_distance_in_units(const msw_sdf *field, const int32_t place[3],
                                  msw_sdf_units *answer);

/* The gradient at a place, in 2^-15. MSW_ERROR_OUT_OF_DOMAIN: outside of the field. */
int32_t msw_sdf_gradient_in_units(const msw_sdf *field, const int32_t place[3],
                                  int32_t gradient[3]);

/* ---- Box tree with distance field, which is asked first: build --for closest,segment,sdf ---- */

/* Opens box tree and distance field of one blob. As msw_open. */
int32_t msw_open_both(msw_both *both, const void *bytes, size_t count);

/* As msw_scratch_entries. */
uint32_t msw_both_scratch_entries(const msw_both *both);

/* As msw_within. If the interval of the field ends more than two units from `distance`, the field
 * answers alone: the work is 0, and MSW_YES has no triangle. Else the tree answers. Only the
 * surface counts. */
int32_t msw_both_within(const msw_both *both, const float point[3], float distance,
                        const msw_budget *budget,
                        msw_scratch_entry *scratch, size_t scratch_count,
                        msw_within_answer *answer);

/* Bounds of the distance of `point` from the surface, to the tolerance of the budget. If the
 * field's interval meets the tolerance, it is the answer. Else the tree searches between its ends.
 */
int32_t msw_both_distance(const msw_both *both, const float point[3],
                          const msw_budget *budget,
                          msw_scratch_entry *scratch, size_t scratch_count,
                          msw_bounds_answer *answer);

/* The same with a sign and a side. Where the field does not tell the side, the tree searches it
 * without a tolerance, as msw_signed_distance. */
int32_t msw_both_signed_distance(const msw_both *both, const float point[3],
                                 const msw_budget *budget,
                                 msw_scratch_entry *scratch, size_t scratch_count,
                                 msw_signed_bounds_answer *answer);

/* As msw_closest_point. The field's interval shortens the search. */
int32_t msw_both_closest_point(const msw_both *both, const float point[3],
                               const msw_budget *budget,
                               msw_scratch_entry *scratch, size_t scratch_count,
                               msw_closest *answer);

/* As msw_solid_first_contact. If the field proves that the motion of a sphere or a capsule is
 * clear, it answers alone. Else the tree answers. */
int32_t msw_both_solid_first_contact(const msw_both *both,
                                     const float *from, const float *to, size_t corner_count,
                                     float radius,
                                     const msw_budget *budget,
                                     msw_scratch_entry *scratch, size_t scratch_count,
                                     msw_hit *answer);

/* ---- Curves: fences and tool paths, built from .csv ---- */

/* Opens the curves of a blob. As msw_open. */
int32_t msw_open_curve(msw_curve *curve, const void *bytes, size_t count);

/* As msw_scratch_entries. */
uint32_t msw_curve_scratch_entries(const msw_curve *curve);

/* Whether the curves are a fence, so that msw_curve_signed_distance answers. Ask once at the start.
 * Errors: MSW_ERROR_NOT_PLANAR: the points differ in z. MSW_ERROR_OPEN_POLYLINE: a polyline is not
 * closed. MSW_ERROR_NULL, _ALIGNMENT, _NOT_OPENED. Cost: linear in the polylines. */
int32_t msw_curve_check_fence(const msw_curve *curve);

/* The closest point of the curves, with an interval that contains its distance.
 *
 * Of equidistant segments the answer is the first in the file. A point on the curve has
 * distance.lower 0. Segments without length are points. Farther than 2^24 times the curve's size
 * the curve's box gives the interval. Cost: a few dozen nodes and segments next to a smooth path of
 * thousands of segments. The worst case is all of them, at the centre of a circle: set
 * budget->steps where time is bounded. */
int32_t msw_curve_closest_point(const msw_curve *curve, const float point[3],
                                const msw_budget *budget,
                                msw_scratch_entry *scratch, size_t scratch_count,
                                msw_curve_closest *answer);

/* Whether the curves are at most `distance` from `point`. Of the budget only `steps` matters.
 *
 * It ends at the first segment that is near enough. If the difference from `distance` is within the
 * surface error and rounding, it is undecided; a distance of 0 is answered by MSW_NO or undecided.
 * Errors: MSW_ERROR_TOLERANCE: the distance is negative, NaN or infinite. Cost: less than that of
 * msw_curve_closest_point. If all of the curve is far away, one node. */
int32_t msw_curve_within(const msw_curve *curve, const float point[3], float distance,
                         const msw_budget *budget,
                         msw_scratch_entry *scratch, size_t scratch_count,
                         msw_curve_within_answer *answer);

/* The `neighbor_count` nearest segments into `neighbors`, by rising distance. Of the budget only
 * `steps` matters.
 *
 * Of two segments whose intervals overlap either may come first. A curve of fewer segments gives
 * them all. After an error the contents of `neighbors` are undefined. Cost: that of
 * msw_curve_closest_point, and two distances in double for each segment near the last one. */
int32_t msw_curve_nearest(const msw_curve *curve, const float point[3],
                          msw_curve_neighbor *neighbors, size_t neighbor_count,
                          const msw_budget *budget,
                          msw_scratch_entry *scratch, size_t scratch_count,
                          msw_nearest_answer *answer);

/* All segments that are, or may be, at most `distance` from `point`, by rising distance, into
 * `neighbors`. Of the budget only `steps` matters.
 *
 * Those that are certainly within the distance come first. Order and far points as in
 * msw_curve_nearest. No neighbors (NULL and 0) is no error: `dropped` is then their number. After
 * an error the contents of `neighbors` are undefined. Errors: those of msw_curve_within. Cost:
 * linear in the segments within the distance. */
int32_t msw_curve_all_within(const msw_curve *curve, const float point[3], float distance,
                             msw_curve_neighbor *neighbors, size_t neighbor_count,
                             const msw_budget *budget,
                             msw_scratch_entry *scratch, size_t scratch_count,
                             msw_all_within_answer *answer);

/* Whether a fence allows `point` (x, y), and how far it is from the nearest line of the fence. The
 * z of the curves is not asked.
 *
 * MSW_SIDE_INSIDE: the point is inside of an inclusion zone, or there is none, and inside of no
 * exclusion zone. Inside of a zone is what its line winds around, once or more often, in either
 * direction. The distance is negative there. It is that to the nearest line of any zone: within
 * -distance.upper inside, and distance.lower outside, the side does not change. The side is
 * never wrong. It is undecided for
 * MSW_REASON_ON_SURFACE on a line and closer to it than the surface error, rounding and the
 * tolerances of the budget. Errors: those of msw_curve_check_fence. Cost: that of
 * msw_curve_closest_point, a comparison of integers for each segment of runs of up to 64 of them,
 * and a capsule for each larger run near the point. */
int32_t msw_curve_signed_distance(const msw_curve *curve, const float point[2],
                                  const msw_budget *budget,
                                  msw_scratch_entry *scratch, size_t scratch_count,
                                  msw_curve_signed *answer);

/* ---- The hull hierarchy: build --for hull. Nested meshes, refined where a scene needs it ---- */

/* Opens the hull hierarchy of a blob. As msw_open. */
int32_t msw_open_hull(msw_hull *hull, const void *bytes, size_t count);

/* Refines a hull around `focus` (NULL: everywhere) until its faces there are no farther than
 * `error` from their part of the surface, and coarsens it elsewhere.
 *
 * Units: `error`, `error_left` and the lengths in `focus` are in the mesh's unit and frame. An
 * `error` of 0 asks for the finest hull. For an eye `error` is the least that counts.
 * `refined` keeps the hull between calls: MSW_REFINED_ENTRIES(splits) entries, with the same count
 * each time. Zeros are the coarsest hull: zero the memory before the first call, or to start anew.
 * With another `hull` it starts from that one's coarsest. Every state is a closed mesh that
 * encloses the surface. If there are too few splits, those of the greatest need are performed, and
 * error_left tells the rest. No scratch.
 * Errors: MSW_ERROR_MEMORY: another count than before, or fewer than two. MSW_ERROR_COUNT: more
 * than 2^24 splits. MSW_ERROR_VALUE: an unknown kind of focus. MSW_ERROR_TOLERANCE: `error` or a
 * length of `focus` is negative, NaN or infinite. MSW_ERROR_NOT_FINITE: a point of `focus` is NaN
 * or infinite. After these errors the hull is as before.
 * Cost: some hundred instructions for each vertex of the coarsest hull and each performed split,
 * some thousand for each change. */
int32_t msw_refine(const msw_hull *hull, msw_refined_entry *refined, size_t refined_count,
                   const msw_focus *focus, float error,
                   msw_refinement *answer);

/* Makes the mesh that a sweep about `point` ends with at `distance`, as the upper end of a closest
 * point: fine near the closest point, and as coarse elsewhere as the tables allow.
 *
 * If is_complete is 1, every triangle of the surface within `distance` of `point` is a face, and
 * any other face stands for a part that is farther. The hull starts from the coarsest one:
 * `performed` counts all splits, and `undone` is 0. Memory and errors as of msw_refine, and
 * MSW_ERROR_TOLERANCE of a distance that is negative, NaN or infinite.
 * Cost: linear in the coarsest hull and the performed splits. */
int32_t msw_refine_swept(const msw_hull *hull, msw_refined_entry *refined, size_t refined_count,
                         const float point[3], float distance,
                         msw_refinement *answer);

/* The faces of a refined hull. With another hull than the one that was refined, and of zeros, they
 * are the coarsest hull's. `faces` may be NULL with a count of 0: `dropped` is then their number.
 * Cost: linear in the coarsest hull and the performed splits. */
int32_t msw_refined_faces(const msw_hull *hull, msw_refined_entry *refined, size_t refined_count,
                          msw_face *faces, size_t face_count,
                          msw_faces_answer *answer);

/* ---- Sweeps that are kept: build --for hull or sweep ----
 *
 * A closest point of a hull hierarchy that is interrupted and goes on, or is asked again after a
 * small motion, or gives one triangle after another. msw_sweep is of a mesh at rest. The frame
 * sweep and the moved sweep further down have the same three functions. */

/* How many scratch entries are always enough for a sweep. 0 if `hull` is not opened. Near scanned
 * parts a thousand hold all; with fewer a sweep begins anew more often. */
uint32_t msw_hull_sweep_entries(const msw_hull *hull);

/* Begins a sweep about `point`. `scratch` belongs to the sweep from now on. After an error the
 * sweep is not begun. Cost: some hundred instructions. */
int32_t msw_sweep_begin(msw_sweep *sweep, const msw_hull *hull, const float point[3],
                        msw_scratch_entry *scratch, size_t scratch_count);

/* Moves the point of a sweep. Cost: constant. */
int32_t msw_sweep_move_to(msw_sweep *sweep, const float point[3]);

/* The closest point, as msw_closest_point says. After MSW_ENDED_STEPS or MSW_ENDED_TOLERANCE
 * another call goes on where this one stopped. Cost: up to twelve triangles after a small motion,
 * else that of a search. */
int32_t msw_sweep_closest_point(msw_sweep *sweep, const msw_budget *budget, msw_closest *answer);

/* The next triangle by rising distance, with its own interval. Once distance.lower exceeds d, every
 * triangle within d has come. After the last one `triangle` is MSW_NO_TRIANGLE and distance.lower
 * infinite. If the search ends early, `triangle` is MSW_NO_TRIANGLE, and no triangle that is left
 * is nearer than distance.lower. After a motion or a closest point the nearest comes again. Of the
 * budget only `steps` matters. */
int32_t msw_sweep_next(msw_sweep *sweep, const msw_budget *budget, msw_closest *answer);

/* ---- Meshes that deform: build --for deform, or sweep,deform ---- */

/* Opens the hull hierarchy of a mesh that deforms. As msw_open. */
int32_t msw_open_deform(msw_deform *deform, const void *bytes, size_t count);

/* The mesh at rest, for questions about a hull hierarchy. */
int32_t msw_deform_hull(msw_hull *hull, const msw_deform *deform);

/* How many scratch entries are always enough for a question about one frame or pose; key frames,
 * the mesh at rest among them; vertices of the input file; vertex records of a moved hull. 0 if
 * `deform` is not opened. */
uint32_t msw_deform_scratch_entries(const msw_deform *deform);
uint32_t msw_deform_frames(const msw_deform *deform);
uint32_t msw_deform_vertices(const msw_deform *deform);
uint32_t msw_deform_records(const msw_deform *deform);

/* The closest point of the mesh at a key frame, or between two: 1.25 is a quarter of the way from
 * frame 1 to frame 2. Errors: MSW_ERROR_NO_FRAME. Else as msw_closest_point. */
int32_t msw_frame_closest_point(const msw_deform *deform, float frame, const float point[3],
                                const msw_budget *budget,
                                msw_scratch_entry *scratch, size_t scratch_count,
                                msw_closest *answer);

/* The first hit of a segment, as msw_first_hit of both facings. Between keys no hit is proved: the
 * way is clear, or undecided. */
int32_t msw_frame_first_hit(const msw_deform *deform, float frame, const float a[3],
                            const float b[3],
                            const msw_budget *budget,
                            msw_scratch_entry *scratch, size_t scratch_count,
                            msw_hit *answer);

/* Begins a hull whose vertices the caller moves, at rest. `records`: msw_deform_records of them,
 * which belong to it from now on. MSW_ERROR_MEMORY: too few. After an error it is not begun. */
int32_t msw_moved_begin(msw_moved *moved, const msw_deform *deform,
                        msw_moved_vertex *records, size_t record_count);

/* Moves the vertices of the mesh. `vertices` has the place of each vertex of the input file, by its
 * number, msw_deform_vertices of them. It is read during the call alone.
 *
 * The bounds of coarse levels stay as they are until the vertices moved by more than `slack` since
 * these were computed; 0 computes them now. A rigid motion of the whole mesh makes bounds loose:
 * carry points into the part's frame instead.
 * Errors: MSW_ERROR_COUNT: too few vertices. MSW_ERROR_TOLERANCE: the slack.
 * MSW_ERROR_OUT_OF_DOMAIN: a vertex is NaN, or 64 times as far as the mesh is large. Then questions
 * are refused by MSW_ERROR_NO_POSE until the next update.
 * Cost: one pass over the vertices of the mesh, or over those of all levels. */
int32_t msw_moved_update(msw_moved *moved, float slack, const float (*vertices)[3],
                         size_t vertex_count);

/* The same questions of the mesh as the last update left it. */
int32_t msw_moved_closest_point(msw_moved *moved, const float point[3],
                                const msw_budget *budget,
                                msw_scratch_entry *scratch, size_t scratch_count,
                                msw_closest *answer);
int32_t msw_moved_first_hit(msw_moved *moved, const float a[3], const float b[3],
                            const msw_budget *budget,
                            msw_scratch_entry *scratch, size_t scratch_count,
                            msw_hit *answer);

/* A sweep of the mesh at a frame, which goes to other frames. After msw_frame_sweep_to bounds lose
 * as much as a vertex moved on the way. MSW_ERROR_NO_FRAME changes nothing. The others are as those of
 * msw_sweep; msw_hull_sweep_entries of the hull at rest are enough. */
int32_t msw_frame_sweep_begin(msw_frame_sweep *sweep, const msw_deform *deform, float frame,
                              const float point[3],
                              msw_scratch_entry *scratch, size_t scratch_count);
int32_t msw_frame_sweep_to(msw_frame_sweep *sweep, float frame);
int32_t msw_frame_sweep_move_to(msw_frame_sweep *sweep, const float point[3]);
int32_t msw_frame_sweep_closest_point(msw_frame_sweep *sweep, const msw_budget *budget,
                                      msw_closest *answer);
int32_t msw_frame_sweep_next(msw_frame_sweep *sweep, const msw_budget *budget,
                             msw_closest *answer);

/* A sweep of a mesh whose vertices the caller moves, at rest when it begins. Arguments are those of
 * msw_moved_begin, msw_moved_update and msw_sweep. */
int32_t msw_moved_sweep_begin(msw_moved_sweep *sweep, const msw_deform *deform,
                              msw_moved_vertex *records, size_t record_count,
                              const float point[3],
                              msw_scratch_entry *scratch, size_t scratch_count);
int32_t msw_moved_sweep_update(msw_moved_sweep *sweep, float slack, const float (*vertices)[3],
                               size_t vertex_count);
int32_t msw_moved_sweep_move_to(msw_moved_sweep *sweep, const float point[3]);
int32_t msw_moved_sweep_closest_point(msw_moved_sweep *sweep, const msw_budget *budget,
                                      msw_closest *answer);
int32_t msw_moved_sweep_next(msw_moved_sweep *sweep, const msw_budget *budget,
                             msw_closest *answer);

/* ---- The library ---- */

/* The meaning of a returned number, as English text that lives for ever. Any number is fine. */
const char *msw_strerror(int32_t error);

/* The version of the library, as MSW_VERSION. */
uint32_t msw_version(void);

/* The newest version of the blob format that it knows: major << 16 | minor. It opens blobs of the
 * same major version. */
uint32_t msw_format_version(void);

/* Whether a verdict proves that there is no contact. 1 only for MSW_NO. */
static inline int msw_is_clear(int32_t verdict) { return verdict == MSW_NO; }

#ifdef __cplusplus
}
#endif

#endif
