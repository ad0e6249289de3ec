//! The texts that `meshsweep help COMMAND` prints below the options.

pub const EXIT_STATUS: &str = "Exit status: 0 done, 1 a file or its content is not usable, or no \
    hull is as tight as asked for, or no setting meets the limits, 2 wrong usage, 3 not proved: a \
    claim that verify proves, or the distance of hausdorff --at-most.";

/// `--queue` of the commands with `--engine`.
pub const QUEUE: &str = "Scratch entries to search with [default: what the blob needs; on the \
    hull hierarchy 4096 more]";

/// `--queue` of pairs of nodes.
pub const PAIRS: &str = "Scratch entries to search with [default: 256, on hull hierarchies \
    what the blobs need, which always suffice]";

/// `--queue` of a distance of two meshes.
pub const NODE_PAIRS: &str = "Scratch entries to search with [default: 384, which always suffice]";

const QUERIES: &str = "Queries are arguments, files, or both, in any number. They are answered in \
    the order given. A file holds one query on a line: decimal numbers with commas, semicolons or \
    blanks between them. A header line, blank lines and comments from # on are skipped. '-' reads \
    the same from the standard input. A file named *.f32 holds raw little-endian f32 numbers. A \
    refused query is named. The answers before it are printed, but not written to a file of -o. \
    work counts the boxes and triangles that a query looked at.";

const TRIANGLES: &str = "triangle is the index of the triangle in the mesh file, counted from 0; \
    a polygon counts as the triangles that it is split into";

pub const BUILD: &str = "Values of --for, and what they cost:\n  \
    closest   closest, within, nearest, field; for a closed mesh also signed: 12 to 13 bytes a \
    triangle\n  \
    segment   segment, overlap, clear, clearance: 12 bytes a triangle; with closest 13 to 15\n  \
    cull      cull: half a byte a triangle more\n  \
    winding   winding, and signed of any mesh, open or not: 1 to 2 bytes a triangle more\n  \
    hull      hull --level, refine, cut, and closest, segment and overlap with --engine hull: \
    25 to 40 bytes a triangle more\n  \
    sweep     as hull, of any mesh, open or not, whose levels enclose nothing\n  \
    triboxes  a union of 1, 2, 4, ... --triboxes chamfered boxes that holds the mesh: 84 to 98 \
    bytes a tribox\n  \
    tight     closest and within, by an interval, and hull --tight: hulls of few faces, 16 to 23 \
    bytes a face\n  \
    deform    closest --frame, and in the library any motion of the vertices: those of hull, and \
    1 to 4 bytes a triangle more; 16 a triangle for each key frame after the first\n  \
    curve     closest and within, of a curve: 6 bytes a point in 2-D, 2 more in 3-D, and 4 to 10 \
    for its node\n\
    closest, segment, cull and winding share a box tree. Any mesh will do for it, open or not, \
    manifold or not. It takes a second for a hundred thousand triangles. hull is the progressive \
    hull with its split tables. It needs a closed manifold mesh and takes far longer. sweep makes \
    the same tables of any mesh: their distances and hits are as true, but no level is a hull. \
    triboxes take any mesh; those of a closed mesh hold its inside too. They take as long as the \
    command tribox. \
    tight makes tight hulls of --tight faces, as the command hull does, of any mesh. Each \
    encloses the mesh and stores the distance of its faces from it. Each takes some seconds. \
    --slack or --void makes one hull, with the fewest faces found that are as tight; if no hull \
    is, nothing is written. Hulls and triboxes hold the mesh as the file has it, before its \
    vertices are rounded; levels of a hull hierarchy enclose the mesh as stored, and hull --level \
    and refine move them off it. With --margin hulls keep a distance from the mesh. Their answers are \
    still about the mesh, with wider intervals. --tight-for closest leaves out the boxes for \
    segments and for overlap, about 2 bytes a face, which only the library asks.\n\n\
    deform takes a closed manifold mesh and its key frames, files with the same triangles in the \
    same order, each triangle from the same first corner. \
    Between two frames every vertex moves on a straight line. Repairs are made on the first mesh \
    and applied to the others; a repair that holds in the first mesh only is refused.\n\n\
    curve reads CSV: x,y or x,y,z on a line, and at most one header line. It is the only value \
    for a file named *.csv. A blank line begins a new polyline; so does another value in a column \
    named polyline. Other columns are skipped. A bad line is named. Repeated points are kept. \
    Segments count from 0 in each polyline.\n\n\
    A polygon of n corners is split into n - 2 triangles: those about its first corner, or ears if \
    that corner does not see all of it. One that crosses itself, seen along the axis nearest to \
    its normal, is split about its first corner. The report counts these, and faces of fewer than \
    three corners, which are left out, and names the first with its line.\n\n\
    OFF is read as text, PLY with faces or triangle strips. Of glTF (.glb, .gltf) the triangles of \
    all nodes of all scenes are read, sparse accessors too, of 3MF the objects of the build, of \
    COLLADA (.dae) all nodes of the scene, each where it is placed. \
    Their transforms are rounded in double precision; every interval includes that. glTF is in \
    metres, 3MF and COLLADA in the unit that they tell. Without --unit nothing is scaled, except \
    COLLADA in a unit that is none of --unit, which is scaled to metres. Axes stay as they are \
    written: up_axis turns nothing, as in RViz and Gazebo. The unit is not stored in the blob: \
    blobs of different units are not told apart, in clearance and overlap too.\n\n\
    Left out, counted and named in the report: triangles that only join strips; points and lines; \
    of OBJ free-form curves and surfaces (curv, curv2, surf and older ones), call, csh and \
    statements of unknown name; of STL attributes; of 3MF supports, items that are not to be \
    printed, negative parts and modifiers; of COLLADA what the scene does not show. Quaternions of \
    glTF that are not of length 1 are named.\n\n\
    Refused by name: skins, morphs, controllers; Draco, meshopt, normalized positions and \
    instances of glTF; beam lattices and required extensions of 3MF; lookat, skew, convex_mesh, brep and \
    polygons with holes of COLLADA; binary OFF; elements of PLY other than face and tristrips that \
    list vertices; a statement of OBJ of unknown name before numbers; facets of STL with several \
    loops; ASCII STL without endsolid, and binary STL whose size does not fit its count and \
    attributes.\n\n\
    Values of --vertex-bits:\n  \
    auto   hull: the fewest bits that store the mesh exactly; box tree: 16, or 32 for a mesh so \
    far from its origin that 16 would move vertices by more than a 32,768th of its longest side, \
    or of which 16 would lose the sides of points\n  \
    16     vertices move to a grid of 16 bits an axis; with tight only those of the hulls, \
    not the mesh's\n  \
    24     hull: a grid of 24 bits an axis; box tree: 32\n  \
    32     single precision; box tree: 8 bytes a triangle more, and no hit is undecided because \
    of the grid\n\
    Every interval includes the quantisation error, which build prints. 32 rounds to single \
    precision. \
    Intervals still include the rounding of single precision: up to four millionths of the \
    distance and of the longest triangle. build prints that too.\n\n\
    Limits choose structure and dials for distances of points, from what trade measures. With \
    --error it is the setting of the fewest instructions, else that of the smallest error. The \
    error is the largest width of an interval among the measured points. Elsewhere an interval \
    may be wider, and holds. --flash is the blob; the library's code comes on top, 18 KB for \
    closest points on a Cortex-M4F. --ram is scratch, what is kept between queries, and the \
    processor's stack. --rate asks for the dearest measured query, times the largest factor by \
    which the fit missed a question's dearest query, at two cycles an instruction. If no setting \
    meets the limits, nothing is written, and the nearest one is named.\n\n\
    Examples:\n  \
    meshsweep build part.stl -o part.msw\n  \
    meshsweep build part.stl -o small.msw --flash 16K --ram 4K --rate 1kHz --cpu m4f:168MHz\n  \
    meshsweep build scan.ply -o scan.msw --for closest\n  \
    meshsweep build part.stl -o part.msw --unit mm\n  \
    meshsweep build part.stl -o part.msw --for closest,segment,hull --base 500\n  \
    meshsweep build part.stl -o proxy.msw --for triboxes --triboxes 16\n  \
    meshsweep build part.stl -o hulls.msw --for tight --tight 50,200,1000\n  \
    meshsweep build part.stl -o hull.msw --for tight --slack 0.5\n  \
    meshsweep build rest.ply bent.ply -o arm.msw --for deform\n  \
    meshsweep build fence.csv -o fence.msw --closed";

pub const INFO: &str = "Examples:\n  \
    meshsweep info part.msw\n  \
    meshsweep info part.msw --json";

pub fn closest() -> String {
    format!(
        "lower and upper enclose the exact distance to the mesh as it was read. They are printed \
         as the shortest decimals that read back as the same f32: round them to f32 before you \
         compare. px, py, pz is a point of its surface, at most upper away. {TRIANGLES}. work \
         depends on the other queries: without --rel, --abs, --steps and --queue the box tree \
         answers thousands at once, and each begins where a neighbour ended.\n\n\
         A tight hull gives an interval as wide as its distance from the mesh. px, py, pz is then \
         the closest point of the hull, and no triangle is named.\n\n\
         A curve names the polyline and its segment, counted from 0. While a query moves by less \
         than safe_motion, the segment remains the closest one; 0 if that is not known.\n\n\
         With --frame the answer is about the mesh at that key frame or between two.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep closest part.msw 10,4.5,7 -1,2,3\n  \
         meshsweep closest part.msw points.csv -o answers.csv\n  \
         meshsweep closest part.msw points.f32 --rel 0.01 --time\n  \
         meshsweep closest arm.msw 10,4.5,7 --frame 0.25\n  \
         generate-points | meshsweep closest part.msw -"
    )
}

pub fn within() -> String {
    format!(
        "The column 'within' says yes or no, both proved; or undecided, if the distance differs \
         from D by less than rounding and the blob's surface error, or if the query ended early. \
         To avoid collisions, treat undecided as yes. Only the surface counts: deep inside a part \
         the answer is no. 'triangle' is one that is near enough; \
         {TRIANGLES}. With --all a last row of undecided without a triangle says that the query \
         ended early and triangles may be missing.\n\n\
         By a tight hull, no means no for the solid with its inside, and undecided means between \
         hull and mesh. A tighter hull may decide.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep within part.msw 10,4.5,7 --distance 2\n  \
         meshsweep within part.msw points.csv --distance 2 --all"
    )
}

pub fn nearest() -> String {
    format!(
        "Queries count from 0, ranks from 1. Each triangle has its own interval and closest \
         point. Two triangles whose intervals overlap may stand in either order. A mesh of fewer \
         than N triangles gives them all; {TRIANGLES}.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep nearest part.msw 10,4.5,7 -n 5\n  \
         meshsweep nearest part.msw points.csv -n 5 -o nearest.csv"
    )
}

pub fn signed() -> String {
    format!(
        "The column 'side' says outside or inside, both proved; or undecided, and then 'reason' \
         says why: open mesh, the mesh bounds no solid; at the surface, the interval of the \
         distance begins at 0; rounding, single precision or the nearest triangle leaves the side undecided; out of \
         steps, out of scratch memory, the query ended early. lower and upper are the bounds of \
         the signed distance, negative inside. If the side is undecided, they are -upper and \
         upper of the distance; {TRIANGLES}.\n\n\
         The side is that of the nearest triangle of a closed mesh. Where the nearest triangle \
         crosses another one or lies inside another part of the mesh, it tells no side, and the \
         side is undecided. With --for closest,winding it is that of the winding number there, and \
         everywhere in an open mesh; such a point takes longer. Name segment too to keep the \
         questions about segments.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep signed part.msw 10,4.5,7\n  \
         meshsweep signed part.msw points.csv -o sides.csv"
    )
}

pub fn winding() -> String {
    format!(
        "The winding number is the sum of the solid angles of all triangles over that of the \
         whole sphere: 1 inside of a closed mesh, 0 outside. Holes, flaps and parts that overlap \
         make it another number: in a hole it falls from nearly 1 to nearly 0, and where two \
         parts overlap it is 2. lower and upper contain it. The column 'side' says inside, which \
         proves a number above 1/2; outside, which proves one between -1/2 and 1/2; or undecided, \
         and then 'reason' says why: rounding, also of the vertices to the grid, or a number below \
         -1/2; out of steps, out of scratch memory. The number is that of all triangles of the mesh file, as they are wound \
         there: one that occurs twice counts twice, and one that occurs in both directions \
         cancels, so parts that share walls are one part. In a part that is inside out the number \
         is nearly -1, and the side is undecided; in a closed mesh that is proved to face inwards \
         as a whole it is inside.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep build scan.ply -o scan.msw --for winding\n  \
         meshsweep winding scan.msw 10,4.5,7\n  \
         meshsweep winding scan.msw points.csv --abs 0.01 -o winding.csv"
    )
}

pub const FIELD: &str = "FILE is raw little-endian f32 if it is named *.f32 or *.raw. It has \
    NumPy's format if it is named *.npy: shape (NZ, NY, NX), so that x runs fastest. Sample (k, \
    j, i) is at origin + (i, j, k) * step, rounded to f32; origin and step are printed. A value \
    is the middle of the interval that contains the distance. With --interval a sample has two \
    values, lower and upper, along a last axis of length 2. With --signed, distances inside are \
    negative. Where the side is not proved, the value is NaN, or with --interval -upper and \
    upper; the number of these samples is printed. The bytes do not depend on the number of \
    threads.\n\n\
    Examples:\n  \
    meshsweep field part.msw -o field.npy\n  \
    meshsweep field part.msw -o field.f32 --size 128,128,64 --margin 2.5 --signed";

pub fn segment() -> String {
    format!(
        "The column 'hit' says yes, with the first hit; no, which is proved; or undecided, if the \
         query ended early, the blob is cut, or rounding and the blob's surface error leave it \
         undecided. The segment is then proved clear before t, and px, py, pz is its point at t. \
         With --all each hit says for itself whether it is proved. An undecided hit is a place \
         where the stored triangle is met and the mesh's may be. Triangles may be missing: those \
         that the segment touches within rounding and the surface error, and all others if the \
         query ended early. Then the query's last row says undecided and names no triangle. Where \
         a segment runs through an edge, one triangle there may be proved to be hit, and not which \
         one: the first of them says yes, the others undecided. t runs from 0 to 1 along the \
         segment, rounded to f32; {TRIANGLES}.\n\n\
         yes proves that the mesh is hit. t, the point and the triangle are those of the stored \
         surface. Within the surface error another triangle of the mesh may come first: --all \
         lists it, perhaps as undecided. Of copies of a triangle with the same winding only the \
         first is stored, unless the blob serves winding numbers.\n\n\
         --facing is by the winding of the mesh file. What build turns is turned for sides \
         only.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep segment part.msw 20,10,90,20,10,-90\n  \
         meshsweep segment part.msw segments.csv --all -o hits.csv\n  \
         meshsweep segment part.msw segments.csv --facing front"
    )
}

const POSES: &str = "A pose moves the second mesh: p becomes R p + (x, y, z). R is the rotation of \
    the quaternion (qw, qx, qy, qz), which need not have length 1 and may not be 0. It is rounded \
    to a matrix of f32, and the answer is about that matrix. --matrix takes any matrix with \
    entries up to 2 as it is; --moves screw only rotations up to a thousandth.";

pub fn clearance() -> String {
    format!(
        "{POSES}\n\n\
         lower and upper enclose the least distance of the two surfaces, the blobs' surface errors \
         included. Both are 0 if it is proved that the surfaces meet. a and b are points of the \
         first and of the second mesh where they are nearest, both in the frame of the first mesh. \
         first and second are their triangles, counted from 0 in the order of their mesh files. \
         Only surfaces count: of a mesh inside of another one it is the distance of the surfaces. \
         With --within the column 'within' says yes or no, both proved; or undecided, if the \
         distance differs from D by no more than rounding and the surface errors, or if the query \
         ended early. Then first and second are triangles that are within D.\n\n\
         With --moves the column 'clear' says yes if it is proved that the surfaces stay apart, \
         farther than D of --within, during the whole move; or undecided, if they are proved to \
         do so only before t, from 0 to 1 along the move. a and b, first and second are where \
         they are then nearest: a collision is undecided too, with the time before which there is \
         none. straight is for poses of equal rotation: between others the mesh shrinks as it \
         turns. screw keeps it rigid, about a fixed axis, by half a turn at most, and of exactly \
         half a turn in either direction. Its origin goes along a helix. If a machine moves \
         otherwise, give poses close together, and add the deviation to --within.\n\n\
         With --depth the column 'solids' says how the closed meshes lie to each other: apart; \
         overlap; first inside or second inside, where the surfaces do not meet and a component of \
         one lies in the other; or undecided. lower and upper enclose the penetration depth, the \
         length of the shortest translation that separates them. Put x, y, z in place of the \
         pose's translation, and they are proved to be apart: it differs by upper at most. p is \
         the point inside both that proves lower: the sum of its depths is lower or more. Both \
         blobs are then built --for closest,segment,winding. If the meshes are deep in each other, \
         upper may be several times as large as lower.\n\n\
         Without --depth both blobs are built --for segment. Poses and moves count from 0. \
         Options with poses stand after the blobs.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep clearance part.msw tool.msw --pose 30,0,0,1,0,0,0\n  \
         meshsweep clearance part.msw tool.msw --pose path.csv --rel 0.01 -o clearance.csv\n  \
         meshsweep clearance part.msw tool.msw --pose path.csv --within 2.5\n  \
         meshsweep clearance part.msw tool.msw --pose path.csv --moves screw\n  \
         meshsweep clearance part.msw tool.msw --pose 3,0,0,1,0,0,0 --depth"
    )
}

pub fn clear() -> String {
    format!(
        "The tool is the hull of the corners of --tool, and all that is within --radius of it: \
         one corner is a ball, two are a capsule, eight a box. Up to 32. Corners are relative to \
         the tool's place, which moves along straight lines. The tool does not turn. The column \
         'clear' says yes if it is proved that no point of the tool touches the mesh during the \
         whole move, at any instant; no if the tool certainly touches it; or undecided, if it \
         comes so near that rounding and the blob's surface error hide whether it does, if a flat \
         tool without radius passes through, or if the query ended early. Only the surface \
         counts: a move inside of a closed mesh may be clear. A move that is not clear is proved \
         clear before t, from 0 to 1 along it. px, py, pz is the place of the mesh that may stop \
         the tool first; {TRIANGLES}. All places of --path are one path, over blank lines and \
         files. The exit status does not tell whether moves are clear. The blob is built --for \
         segment.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep clear part.msw 20,10,90,20,10,-90 --radius 3\n  \
         meshsweep clear part.msw segments.csv --tool 0,0,0,0,0,40 --radius 3 -o moves.csv\n  \
         meshsweep clear part.msw --path points.csv --tool 0,0,0,0,0,40 --radius 3"
    )
}

pub fn overlap() -> String {
    format!(
        "{POSES}\n\n\
         The column 'contact' says apart or meets, both proved; or undecided, if the surfaces \
         touch or come nearer than rounding and the blobs' surface errors, or if the query ended \
         early. Only surfaces count: a mesh inside of another one is apart from it. first and \
         second are triangles that meet, counted from 0 in the order of their mesh files. With \
         --all each line has one pair, undecided pairs included; an undecided line without \
         triangles says that pairs may be missing. Poses count from 0. Options with poses stand \
         after the blobs.\n\n\
         {QUERIES}\n\n\
         Examples:\n  \
         meshsweep overlap part.msw part.msw --pose 30,0,0,1,0,0,0\n  \
         meshsweep overlap part.msw part.msw --matrix 0,-1,0,5,1,0,0,5,0,0,1,0 --all\n  \
         meshsweep overlap part.msw tool.msw --pose path.csv -o contacts.csv"
    )
}

pub const CULL: &str = "A leaf of up to eight triangles is kept or culled as a whole, by a cone \
    that contains its normals. So some of the listed triangles face away. All others certainly \
    do, as they are stored: with vertices on a grid a triangle that is seen edge-on may differ \
    from the mesh file's. The front of a triangle is the side from which its corners run \
    counter-clockwise, as the mesh file lists them: what build turns is turned for sides only. Any \
    mesh will do, open or not.\n\n\
    Examples:\n  \
    meshsweep build part.stl -o part.msw --for closest,cull\n  \
    meshsweep cull part.msw 100,-50,30\n  \
    meshsweep cull part.msw --along 0,0,-1 -o facing.csv";

pub const HULL: &str = "The hull of a mesh is closed, does not cross itself, and has every \
    triangle of the mesh strictly inside. Exact arithmetic on the written vertices proves it. The \
    mesh may be open, or loose triangles; cavities are filled.\n\n\
    The mesh is that of the file: decimals and doubles count as they are written, but for a \
    decimal whose nearest double is a single, which counts as that single. Vertices are rounded to \
    single precision first, and the output tells by how much. Hulls of both kinds then keep that \
    distance from the rounded mesh too. So does a mesh that --vertex-bits moves to a grid. Void \
    and distances are those of the rounded mesh.\n\n\
    --faces gives the least volume found. A thin spike may stand out far, which --slack forbids. \
    --void and --slack search for few faces. That may take several times as long, and minutes \
    where the mesh is open, its parts touch, or a margin is asked for. If no hull is as tight, \
    nothing is written. With --seconds the hull depends on the machine. It has more faces than \
    asked for if the time was too short to remove them. With --parts each connected component has \
    a hull, each with the faces and the seconds that are asked for. Hulls of neighbours may \
    cross.\n\n\
    With --margin all points within that distance of the mesh are inside, proved too. --void then counts the volume of the margin as well. \
    --slack is measured from the mesh with rounded vertices and must be more: twice the margin, \
    say, for corners stand off farther than walls.\n\n\
    --progressive gives the progressive hull, like the levels of a hull hierarchy. It is looser, \
    uses the mesh's own vertices where it can, and needs a closed manifold mesh. It may touch the \
    mesh and itself. If vertices were rounded, it is moved off the mesh; if no such hull is proved \
    to enclose the file's mesh, nothing is written. With --level a hull is moved in the same way, \
    or the output tells by how much the file's mesh may stick out of it. --effort lowers the volume, not the distance.\n\n\
    Examples:\n  \
    meshsweep hull part.stl --faces 200 -o hull.ply\n  \
    meshsweep hull part.stl --slack 2.5 -o hull.ply\n  \
    meshsweep hull part.stl --margin 0.5 -o hull.ply\n  \
    meshsweep hull scan.ply --faces 500 --effort 4 -o hull.ply\n  \
    meshsweep hull part.msw --level 0 -o coarsest.ply\n  \
    meshsweep hull hulls.msw --tight 200 -o hull.ply";

pub const REFINE: &str = "Of a blob built --for hull the mesh that is written is closed \
    and encloses the part. If vertices of the mesh file were rounded or moved to a grid, the hull \
    is moved off the stored mesh to enclose the file's; if that is not proved, the output tells by \
    how much the file's may stick out. Of one built --for sweep it lies near the part, is open where the part \
    is, and encloses nothing. A face that meets the focus is no farther than --error from the \
    part of the mesh that it stands for. If memory is too short for that, the output prints the \
    largest error of the splits that were left out. Without a focus the whole hull is refined. \
    With --eye a face may have the error of one of --pixels at its distance.\n\n\
    Examples:\n  \
    meshsweep refine part.msw --error 0.1 -o hull.ply\n  \
    meshsweep refine part.msw --near 10,0,5 --within 4 --error 0.01 -o hull.ply\n  \
    meshsweep refine part.msw --box 0,0,0,10,10,5 --error 0.01 -o hull.ply\n  \
    meshsweep refine part.msw --segment 0,0,9,0,0,-9 --within 1 --error 0 -o hull.ply\n  \
    meshsweep refine part.msw --eye 0,0,90 --look 0,0,-1 --fov 50 --pixels 1000 -o hull.ply";

pub const HAUSDORFF: &str = "lower and upper enclose the exact distance of the meshes as they were \
    read, open or closed, with any number of connected components. a and b are points of the first \
    and of the second mesh: one of them is the farthest that was found, the other its closest \
    point. ended says whether the precision was reached, or why not. Vertices are read as f32: \
    lower and upper include that rounding, and no distance is known better. Triangles are counted \
    from 0 in their file; a polygon counts as the triangles that it is split into. Triangles \
    without area count like all others.\n\n\
    --profile and --heat look at the first mesh alone: holes of a scan show only with the complete \
    mesh first. quantiles bound the distance that a part of the area does not exceed.\n\n\
    With --at-most the exit status is 0 if the distance is proved to be at most that, 3 if it is \
    not, 1 if a file is not usable, 2 for wrong usage.\n\n\
    Examples:\n  \
    meshsweep hausdorff part.stl scan.ply --rel 1e-6\n  \
    meshsweep hausdorff part.stl scan.ply --one-sided --json\n  \
    meshsweep hausdorff part.stl scan.ply --profile --heat deviation.ply\n  \
    meshsweep hausdorff part.stl scan.ply --at-most 1000";

pub const CUT: &str = "meshsweep info lists the levels. --level leaves the box tree out: it holds \
    all of the surface or nothing.\n\n\
    Triboxes stay as they are unless --triboxes is given, and tight hulls unless --tight is. \
    Without --level the rest stays. With --level key frames are left out too.\n\n\
    Examples:\n  \
    meshsweep cut part.msw --level 2 -o small.msw\n  \
    meshsweep cut part.msw --triboxes 8 -o small.msw\n  \
    meshsweep cut hulls.msw --tight 200 -o small.msw";

pub const TRIBOX: &str = "A tribox is the intersection of nine slabs, along the axes and the \
    diagonals of the coordinate planes: a box with chamfered edges. Each level holds the mesh, \
    and the inside of a closed mesh. Triboxes of a level do not overlap, unless --simplify moves \
    their planes, or vertices were rounded. They then hold the mesh as the file has it.\n\n\
    'faces' counts the faces of all triboxes. 'compression' is the mesh's triangles divided by \
    them. 'void %' is the volume beside the solid. 'hull error' is how far a tribox reaches \
    beyond the convex hull of the triangles in it. 'largest distance' is from the union's \
    boundary to the mesh, between two proved bounds. Lengths are in the mesh's unit. The written \
    vertices are exact, and the triboxes enclose the mesh.\n\n\
    Examples:\n  \
    meshsweep tribox part.stl\n  \
    meshsweep tribox part.stl --levels 5 --simplify 0.5 -o proxy.ply\n  \
    meshsweep tribox scan.ply --json";

pub const VERIFY: &str = "The proofs share no code with the builder and with queries, but for \
    reading the mesh and its repair, which are those of build. So they tell of a blob whether its \
    answers are about this mesh, and whether the builder erred.\n\n  \
    box tree        each triangle of the mesh is stored once within the error; boxes, normal cones \
    and moments hold all that is below them\n  \
    hull hierarchy  each level encloses the finer ones, radii cover, the finest surface is the \
    mesh within the error\n  \
    key frames      each vertex is where the frame's mesh has it, radii may be interpolated\n  \
    tight hulls     each encloses the mesh, and the file's triangles before rounding, and is as \
    near as stated\n  \
    triboxes        each level holds the mesh, the file's triangles before rounding, and the \
    inside of a solid\n  \
    curve           each point is stored within the error and is in all its capsules\n\n\
    Integers decide planes, boxes, places and meetings. Radii and distances of surfaces are \
    compared in f64. A line says what was proved, what failed and where, or what there is no proof \
    of.\n\n\
    Exit status: 0 all is proved, 1 a file is not usable, 2 wrong usage, 3 a proof failed or is \
    missing.\n\n\
    Examples:\n  \
    meshsweep verify part.msw part.stl\n  \
    meshsweep verify part.msw part.stl --json";

pub const TRADE: &str = "The guaranteed error is the width of an interval, which holds; the \
    largest and the median of the points are printed. It is measured: at another point the \
    interval may be wider. The found error is the distance in f64, from all triangles, less the \
    lower end, which a caller uses that must keep clear; and the upper end less that \
    distance.\n\nInstructions of a Cortex-M4F and a Cortex-M0 are predicted from the nodes, \
    triangles and splits of each query, in the order in which boards search. The costs were fitted \
    to counts in an emulator; the errors of the prediction are printed below. Flash is the blob \
    without the library's code.\n\nThe first table has the settings that no other one beats in the \
    largest guaranteed error, the mean instructions of a Cortex-M4F and the bytes of flash \
    together. Triboxes have a lower end only. A structure that the mesh does not allow is listed \
    with the reason. Tight hulls are made with --effort 0; more effort makes them tighter. \
    Coherent queries are measured along a path and at your own points. build --flash, --ram, \
    --error and --rate choose among the same settings.\n\n--report writes one HTML file, which a \
    browser shows without a network. It has the numbers of --json: error against instructions and \
    bytes; the intervals of a few settings along a path, and the true distance; the mesh with a \
    tight hull, triboxes and a cut level, to turn and to cut, coloured by the hull's distance \
    from the mesh or by the width of intervals, with the worst queries marked.\n\nExamples:\n  \
    meshsweep trade part.stl\n  \
    meshsweep trade part.stl --report part.html\n  \
    meshsweep trade part.stl --at path --points 500\n  \
    meshsweep trade part.stl --at points.csv --json";

pub const WORST: &str = "Queries are searched in the box twice the mesh's: from random places and \
    some of the surface, uphill, by moves of all sizes. The same blob gives the same result. The \
    search proves nothing: a dearer query may exist. Only --steps bounds the cost of every query. \
    With it the widest interval is searched too, for questions that have one. Its width at other \
    queries is most likely less, and any answer tells its own.\n\n\
    Work is counted as queries count it: nodes or splits opened, bounds (boxes, capsules, balls) \
    and triangles looked at, and those of them in f64. For closest, instructions of boards are \
    predicted from it, as meshsweep trade does; its help tells how well. They are then what is \
    climbed.\n\n\
    Examples:\n  \
    meshsweep worst part.msw\n  \
    meshsweep worst part.msw --ask closest --rel 0.01\n  \
    meshsweep worst part.msw --steps 16 --json";
