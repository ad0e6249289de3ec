//! What `meshsweep help COMMAND` says below the options.

pub const EXIT_STATUS: &str = "Exit status: 0 done, 1 a file or its content is not usable or no hull is as tight as asked for, 2 wrong usage.";

/// Of `--queue` where there is `--engine`.
pub const QUEUE: &str = "Stack or queue entries to search with [default: what the blob needs; on the cover tree no less than 4096]";

/// Of `--steps` for segments.
pub const STEPS: &str =
    "Stop a query after opening so many nodes, on the cover tree only (--engine cover)";

/// Of `--queue` for pairs of nodes.
pub const PAIRS: &str = "Stack entries to search with [default: 128, which are always enough]";

const QUERIES: &str = "Queries are written as arguments, or in files, or both: as many as wanted, answered in the order given. \
    A file holds decimal numbers separated by commas, semicolons or blanks, one query on a line; a header line, blank lines and \
    comments from # on are skipped. '-' reads this from the standard input. A file named *.f32 holds raw little-endian f32 numbers. A \
    query that is refused is named; the answers to those before it are printed, but not written to a file of -o.";

const TRIANGLES: &str = "triangle counts the triangles of the mesh file from 0, in its order, each polygon being split into triangles \
    about its first corner";

pub const BUILD: &str = "What --for takes, and what it costs:\n  \
    closest   closest, within, nearest, field; signed too if the mesh is closed: 13 to 14 bytes a triangle\n  \
    segment   segment, overlap: 12 bytes a triangle; with closest 15\n  \
    cull      cull: half a byte a triangle more\n  \
    hull      hull --level, cut, and closest and segment with --engine cover or hull: 35 to 50 bytes a triangle more\n  \
    triboxes  a union of 1, 2, 4, ... --triboxes chamfered boxes that holds the mesh: 84 to 98 bytes a tribox\n  \
    tight     closest and within, by an interval, and hull --tight: hulls of few faces, 16 to 23 bytes a face\n\
    The first three share a box tree, which any mesh will do for, open or not, manifold or not, and which takes a second for a \
    hundred thousand triangles. hull is the progressive hull with its split tables; it needs a closed manifold mesh and takes far \
    longer. triboxes will do with any mesh; if it is closed they hold its inside too. They take as long as the command tribox. tight wraps the mesh in hulls of \
    --tight faces, as the command hull does: each encloses it, and knows how far its faces are from the mesh. They too will do with any mesh, and take some seconds each. \
    With --slack or --void there is one hull, with the fewest faces found that are as tight, and none is written if no hull is. With --margin hulls keep a distance from the mesh; answers \
    are about the mesh all the same, by wider intervals. \
    With --tight-for closest they take about 2 bytes a face less: boxes for segments and for overlap with a hull are left out, which no command asks, only who links the library.\n\n\
    What --vertex-bits means:\n  \
    auto   hull: the fewest bits that store the mesh exactly; box tree: 16\n  \
    16     vertices move to a grid of 16 bits an axis; tight hulls: their own, the mesh does not\n  \
    24     hull: a grid of 24 bits an axis; box tree: 32\n  \
    32     single precision; box tree: 8 bytes a triangle more, and no hit is left open for the vertices' sake\n\
    Whatever moves is in every answer's interval; the report says how far. With 32 nothing moves, but intervals still carry the rounding \
    of single precision: about two millionths of the distance, and of the longest triangle; the report says what that comes to.\n\n\
    Examples:\n  \
    meshsweep build part.stl -o part.msw\n  \
    meshsweep build scan.ply -o scan.msw --for closest\n  \
    meshsweep build part.stl -o part.msw --for closest,segment,hull --base 500\n  \
    meshsweep build part.stl -o proxy.msw --for triboxes --triboxes 16\n  \
    meshsweep build part.stl -o hulls.msw --for tight --tight 50,200,1000\n  \
    meshsweep build part.stl -o hull.msw --for tight --slack 0.5";

pub const INFO: &str = "Examples:\n  \
    meshsweep info part.msw\n  \
    meshsweep info part.msw --json";

pub fn closest() -> String {
    format!(
        "lower and upper enclose the distance to the mesh as it was read, in real arithmetic; px, py, pz are a point of its surface at \
         most upper away; {TRIANGLES}; work counts boxes and triangles that were looked at, \
         and depends on the queries beside it: without --rel, --abs, --steps and --queue the box tree takes thousands at once, in an \
         order in which each begins where a neighbour ended.\n\n\
         A tight hull gives an interval as wide as it stands off from the mesh; px, py, pz are then the closest point of the hull, and there is no triangle.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep closest part.msw 10,4.5,7 -1,2,3\n  \
         meshsweep closest part.msw points.csv -o answers.csv\n  \
         meshsweep closest part.msw points.f32 --rel 0.01 --time\n  \
         generate-points | meshsweep closest part.msw -"
    )
}

pub fn within() -> String {
    format!(
        "The column 'within' says yes or no, which is proved; or unknown, if the distance differs from D by less than rounding and the \
         surface error of the blob, or the query ended early. 'triangle' is one that is near enough; {TRIANGLES}. With --all a last row of unknown \
         without a triangle says that the query ended early, and triangles may be missing.\n\n\
         By a tight hull, no holds for a solid with its inside; unknown is between hull and mesh, where a tighter hull may tell.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep within part.msw 10,4.5,7 --distance 2\n  \
         meshsweep within part.msw points.csv --distance 2 --all"
    )
}

pub fn nearest() -> String {
    format!(
        "Queries count from 0, ranks from 1. Each triangle has its own interval and closest point; two whose intervals overlap may stand \
         in either order. A mesh of fewer than N triangles gives them all; {TRIANGLES}.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep nearest part.msw 10,4.5,7 -n 5\n  \
         meshsweep nearest part.msw points.csv -n 5 -o nearest.csv"
    )
}

pub fn signed() -> String {
    format!(
        "The column 'side' says outside or inside, which is proved; or undefined, and then 'reason' says why: open mesh, if the mesh does \
         not bound a solid; at the surface, if the point cannot be told from a point of it; rounding, if single precision leaves the \
         side open; out of steps, out of stack, if the query ended early. lower and upper are the bounds of the signed distance, \
         negative inside; if the side is undefined, they are -upper and upper of the distance; {TRIANGLES}.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep signed part.msw 10,4.5,7\n  \
         meshsweep signed part.msw points.csv -o sides.csv"
    )
}

pub const FIELD: &str = "FILE is raw little-endian f32 if it is named *.f32 or *.raw, and NumPy's format if it is named *.npy: shape \
    (NZ, NY, NX), so that x runs fastest. Sample (k, j, i) is at origin + (i, j, k) * step, rounded to f32; origin and step are \
    printed. A value is the middle of the interval that contains the distance. With --interval there are two values a sample, lower \
    and upper, as a last axis of length 2. With --signed, distances inside are negative; where the side is not proved the value is \
    NaN, or with --interval -upper and upper; how many these are is printed. The bytes do not depend on the number of threads.\n\n\
    Examples:\n  \
    meshsweep field part.msw -o field.npy\n  \
    meshsweep field part.msw -o field.f32 --size 128,128,64 --margin 2.5 --signed";

pub fn segment() -> String {
    format!(
        "The column 'hit' says yes, with the first hit; no, which is proved; or unknown, if the query ended early, the blob is cut, or \
         rounding and the surface error of the blob leave it open: then the segment is proved clear before t, which px, py, pz belong \
         to. With --all an unknown hit is a place where the stored triangle is met and the mesh's may be. t runs from 0 to 1 along the \
         segment, rounded to f32; {TRIANGLES}.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep segment part.msw 20,10,90,20,10,-90\n  \
         meshsweep segment part.msw segments.csv --all -o hits.csv\n  \
         meshsweep segment part.msw segments.csv --facing front"
    )
}

pub fn overlap() -> String {
    format!(
        "A pose moves the second mesh: p becomes R p + (x, y, z), R being the rotation of the quaternion (qw, qx, qy, qz), which need not have length 1 and may \
         not be 0. It is rounded to a matrix of f32, and what is said is about that. --matrix takes any matrix with entries up to 2 as it is.\n\n\
         The column 'contact' says apart or meets, which is proved; or open, if the surfaces touch, come nearer than rounding and the blobs' surface errors can \
         tell, or the query ended early. Surfaces alone count: a mesh inside of another one is apart from it. first and second are triangles that meet, counted from 0 in \
         the order of their mesh files; with --all one pair is on each line, open ones among them, and an open without triangles says that pairs may be missing. \
         Poses count from 0. Options with poses stand after the blobs.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep overlap part.msw part.msw --pose 30,0,0,1,0,0,0\n  \
         meshsweep overlap part.msw part.msw --matrix 0,-1,0,5,1,0,0,5,0,0,1,0 --all\n  \
         meshsweep overlap part.msw tool.msw --pose path.csv -o contacts.csv"
    )
}

pub const CULL: &str = "Leaves of up to eight triangles are kept or left out whole, by cones that contain their normals, so some of \
    the triangles that are listed face away. What is not listed certainly does, as it is stored: with vertices on a grid a triangle \
    seen edge-on may differ from the mesh file's. The front of a triangle is where its corners run \
    counter-clockwise; any mesh will do, open or not.\n\n\
    Examples:\n  \
    meshsweep build part.stl -o part.msw --for closest,cull\n  \
    meshsweep cull part.msw 100,-50,30\n  \
    meshsweep cull part.msw --along 0,0,-1 -o facing.csv";

pub const HULL: &str = "The hull of a mesh is closed, does not pass through itself, and has every triangle of the mesh strictly inside: proved by exact \
    arithmetic on the vertices that are written. The mesh may be open, or a heap of loose triangles; cavities are filled. With --void or --slack \
    few faces are searched for, which may take several times as long as a number of --faces, and minutes where the mesh is open, its parts touch, or a margin is asked for; \
    if none is found that is as tight, nothing is written. With --seconds the hull depends on the machine, and has more faces than asked for if the time did not \
    suffice to get rid of them. With --faces the hull has as little volume as is found: something thin may stand out far, which --slack forbids. With --parts there is a hull for each part, each with the faces and the seconds that are asked for; those of \
    neighbours may cross.\n\n\
    With --margin the hull has no point as near to the mesh as that, so that everything within the margin is inside: proved too, and for the mesh as the file \
    has it, before its vertices were rounded. --void then counts the margin's volume as well, and --slack, which is measured from the mesh with its vertices \
    rounded, must be more: twice the margin, say, for corners stand off farther than walls.\n\n\
    --progressive gives the progressive hull, as the levels of a blob's hull hierarchy are: looser, at the mesh's own vertices where it can be, and only of meshes that \
    are closed and manifold; it may touch the mesh, and itself. --effort makes for less volume, not for less distance.\n\n\
    Examples:\n  \
    meshsweep hull part.stl --faces 200 -o hull.ply\n  \
    meshsweep hull part.stl --slack 2.5 -o hull.ply\n  \
    meshsweep hull part.stl --margin 0.5 -o hull.ply\n  \
    meshsweep hull scan.ply --faces 500 --effort 4 -o hull.ply\n  \
    meshsweep hull part.msw --level 0 -o coarsest.ply\n  \
    meshsweep hull hulls.msw --tight 200 -o hull.ply";

pub const CUT: &str = "meshsweep info lists the levels. A box tree is left out: it knows the whole surface or none of it.\n\n\
    Triboxes stay as they are unless --triboxes is given, and tight hulls unless --tight is; without --level all else stays.\n\n\
    Examples:\n  \
    meshsweep cut part.msw --level 2 -o small.msw\n  \
    meshsweep cut part.msw --triboxes 8 -o small.msw\n  \
    meshsweep cut hulls.msw --tight 200 -o small.msw";

pub const TRIBOX: &str = "A tribox is what nine slabs have in common, along the axes and the diagonals of the coordinate planes: a box whose twelve edges are \
    chamfered. Each level holds the mesh; if it is closed, its inside too. Triboxes of a level do not overlap, unless --simplify moves their planes.\n\n\
    'faces' counts those of all triboxes, 'compression' is the mesh's triangles over it. 'void %' is what they hold beside the solid. 'hull error' is how \
    far a tribox reaches beyond the convex hull of its part; 'largest distance' is from the union's boundary to the mesh, between two \
    proved bounds. Lengths are in the mesh's unit. In what is written every vertex is exact, and the triboxes enclose the mesh.\n\n\
    Examples:\n  \
    meshsweep tribox part.stl\n  \
    meshsweep tribox part.stl --levels 5 --simplify 0.5 -o proxy.ply\n  \
    meshsweep tribox scan.ply --json";
