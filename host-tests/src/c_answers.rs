//! The lines that `c-answers/answers.c` has to print: the same questions, asked of `meshsweep-core`
//! itself. It shares no code with the C interface: codes and the order of fields are written here
//! once more.

mod kept;

use crate::corrupt::{entry, put_u32, seal, word};
use meshsweep_core::internal::format::layout::VERSION_MAJOR;
use meshsweep_core::{
    Blob, Budget, Bvh, BvhWithSdf, ClosestPoint, CoherentPair, CoherentQuery, CoherentScene, Curve,
    CurveClosest, CurveNeighbor, Decided, Ended, Facing, FieldDistance, FirstHit, Focus, Hint, Hit,
    Hull, Interval, KeptPair, Motion, Neighbor, NodePair, PairDistance, PlacedModel, Pose,
    QueryError, RefinedHull, RoundedPose, Scratch, Sdf, Side, Solid, TightHulls, Triboxes,
    Undecided, Verdict, Work,
};

const ROUNDS: usize = 24;
const PAIR_ROUNDS: usize = 6;
const SPLITS: usize = 60;
const FACES: usize = 48;
const SCRATCH: usize = Bvh::DISTANCE_ENTRIES;
/// The kind of section that holds the box tree's header, and the place of the grid's origin in it.
const BOX_TREE: u32 = 12;
const GRID_ORIGIN: usize = 8;

/// Random numbers, and the hash of answers.
struct Kind {
    state: u32,
    hash: u32,
}

impl Kind {
    const fn begin() -> Self {
        Self { state: 1, hash: 0x811C_9DC5 }
    }

    fn coordinate(&mut self) -> f32 {
        self.state = self.state.wrapping_mul(1_664_525).wrapping_add(1_013_904_223);
        (f64::from(self.state >> 16) - 32768.0) as f32 / 512.0
    }

    fn point(&mut self) -> [f32; 3] {
        [(); 3].map(|()| self.coordinate())
    }

    fn pose(&mut self, round: usize) -> Pose {
        let turned = [[0.0, -1.0, 0.0], [1.0, 0.0, 0.0], [0.0, 0.0, 1.0]];
        let rotation = if round % 2 == 1 { turned } else { Pose::IDENTITY.rotation };
        Pose::rigid(rotation, self.point())
    }

    /// Every other one mirrors.
    fn affine(&mut self, round: usize) -> Pose {
        let Pose { mut rotation, translation, .. } = self.pose(round);
        if round.is_multiple_of(2) {
            return Pose::rigid(rotation, translation);
        }
        rotation[2][2] = -1.0;
        Pose::affine(rotation, translation)
    }

    fn words(&mut self, words: &[u32]) {
        for word in words {
            self.hash = (self.hash ^ word).wrapping_mul(16_777_619);
        }
    }

    fn floats(&mut self, floats: &[f32]) {
        floats.iter().for_each(|float| self.words(&[float.to_bits()]));
    }

    fn interval(&mut self, Interval { lower, upper }: Interval) {
        self.floats(&[lower, upper]);
    }

    fn work(&mut self, work: Work) {
        self.words(&[work.bounds, work.triangles, work.exact, work.opened]);
    }

    fn verdict(&mut self, verdict: Verdict) {
        self.words(&match verdict {
            Verdict::Yes => [1, 1],
            Verdict::No => [2, 1],
            Verdict::Undecided(why) => [0, reason(why)],
            other => unreachable!("{other:?}"),
        });
    }

    fn side(&mut self, side: Side) {
        self.words(&match side {
            Side::Inside => [1, 1],
            Side::Outside => [2, 1],
            Side::Undecided(why) => [0, reason(why)],
            other => unreachable!("{other:?}"),
        });
    }

    /// A step from `place`.
    fn step(&mut self, place: &mut [f32; 3]) {
        let step = self.point();
        *place = [0, 1, 2].map(|axis| place[axis] + step[axis] / 1024.0);
    }

    /// Without its work: processors with vector registers may visit nodes in another order.
    fn closest(&mut self, near: &ClosestPoint) {
        self.interval(near.distance);
        self.floats(&near.point);
        self.words(&[near.triangle.unwrap_or(u32::MAX), ended(near.ended)]);
    }

    fn first_hit(&mut self, found: &FirstHit) {
        let is_proved = found.hit.is_some() && found.ended == Ended::Exact;
        let verdict = if found.is_clear() { 2 } else { u32::from(is_proved) };
        self.words(&[verdict, ended(found.ended)]);
        self.interval(found.t);
        let hit = found.hit.unwrap_or(Hit::EMPTY);
        self.floats(&[hit.t]);
        self.floats(&hit.point);
        self.words(&[hit.triangle.unwrap_or(u32::MAX)]);
        self.work(found.work);
    }

    fn within_of(&mut self, found: &Decided<[u32; 2]>) {
        self.verdict(found.verdict);
        self.words(&found.witness.unwrap_or([u32::MAX; 2]));
        self.work(found.work);
    }

    fn pair_distance(&mut self, found: &PairDistance) {
        self.interval(found.distance);
        self.floats(found.points.as_flattened());
        self.words(&found.triangles);
        self.words(&[ended(found.ended)]);
        self.work(found.work);
    }

    fn line(&self, name: &str) -> String {
        format!("{name} {:08x}\n", self.hash)
    }
}

fn ended(ended: Ended) -> u32 {
    match ended {
        Ended::Exact => 1,
        Ended::Tolerance => 2,
        Ended::Steps => 3,
        Ended::Scratch => 4,
        Ended::Resolution => 5,
        other => unreachable!("{other:?}"),
    }
}

fn reason(why: Undecided) -> u32 {
    match why {
        Undecided::Steps => 2,
        Undecided::Scratch => 3,
        Undecided::Resolution => 4,
        Undecided::OpenMesh => 5,
        Undecided::OnSurface => 6,
        Undecided::Feature => 7,
        other => unreachable!("{other:?}"),
    }
}

fn budget(round: usize) -> Budget {
    match round % 3 {
        0 => Budget::EXACT,
        1 => Budget::EXACT.with_steps(3),
        _ => Budget::EXACT.with_relative(0.25).with_absolute(0.5),
    }
}

fn entries(round: usize) -> usize {
    if round % 3 == 2 { 6 } else { SCRATCH }
}

/// One line for each kind of question.
///
/// # Errors
/// A blob that does not open, or a refused question.
pub fn lines(
    groove: &[u8],
    hulls: &[u8],
    bracket: &[u8],
    torus: &[u8],
    fence: &[u8],
    [field, both]: [&[u8]; 2],
    bend: &[u8],
) -> Result<String, Box<dyn std::error::Error>> {
    let model = Bvh::open(groove)?;
    let mut kind = Kind::begin();
    let version = env!("CARGO_PKG_VERSION").split('.').map(str::parse::<u32>);
    let version = version.collect::<Result<Vec<_>, _>>()?.iter().fold(0, |all, n| all << 8 | n);
    let checksum = Blob::checksum(groove)?;
    let entries = model.scratch_entries() as u32;
    kind.words(&[0, 0, 0, checksum, entries, version, VERSION_MAJOR.into()]);
    let mut text = kind.line("open");
    text += &points(&model)?;
    text += &walks(&model)?;
    text += &a_replaced_model(groove)?;
    text += &segments(&model)?;
    text += &rays(&model)?;
    text += &moved_solids(&model)?;
    text += &two_models(&model)?;
    text += &scene(&model)?;
    text += &poses()?;
    text += &triboxes(torus)?;
    text += &curves(fence)?;
    text += &distance_field(field)?;
    text += &field_first(both)?;
    text += &tight_hull(hulls)?;
    text += &refined_hull(bracket)?;
    text += &kept::sweeps(bracket)?;
    text += &kept::frames(bend)?;
    text += &kept::moved(bend)?;
    Ok(text + &refusals())
}

/// Asks a question of each round; 0, as C returns, comes before each answer.
fn rounds(
    name: &str,
    ask: impl FnMut(&mut Kind, usize, Budget, &mut Scratch<SCRATCH>) -> Result<(), QueryError>,
) -> Result<String, QueryError> {
    some_rounds(ROUNDS, name, ask)
}

fn some_rounds(
    count: usize,
    name: &str,
    mut ask: impl FnMut(&mut Kind, usize, Budget, &mut Scratch<SCRATCH>) -> Result<(), QueryError>,
) -> Result<String, QueryError> {
    let (mut kind, mut scratch) = (Kind::begin(), Scratch::new());
    for round in 0..count {
        ask(&mut kind, round, budget(round), &mut scratch)?;
    }
    Ok(kind.line(name))
}

fn points(model: &Bvh<'_>) -> Result<String, QueryError> {
    let closest = rounds("closest_point", |kind, round, budget, scratch| {
        let near = model.closest_point(kind.point(), budget, &mut scratch[..entries(round)])?;
        kind.words(&[0]);
        kind.closest(&near);
        Ok(())
    })?;
    let signed = rounds("signed_distance", |kind, round, budget, scratch| {
        let found = model.signed_distance(kind.point(), budget, &mut scratch[..entries(round)])?;
        kind.words(&[0]);
        kind.side(found.side);
        kind.interval(found.distance);
        kind.closest(&found.closest);
        Ok(())
    })?;
    let winding = rounds("winding_number", |kind, round, budget, scratch| {
        let found = model.winding_number(kind.point(), budget, &mut scratch[..entries(round)])?;
        kind.words(&[0]);
        kind.interval(found.number);
        kind.side(found.side);
        kind.words(&[ended(found.ended)]);
        kind.work(found.work);
        Ok(())
    })?;
    let within = rounds("within", |kind, round, budget, scratch| {
        let found = model.within(kind.point(), 20.0, budget, &mut scratch[..entries(round)])?;
        kind.words(&[0]);
        kind.verdict(found.verdict);
        kind.words(&[found.witness.unwrap_or(u32::MAX)]);
        kind.work(found.work);
        Ok(())
    })?;
    let nearest = rounds("nearest", |kind, round, budget, scratch| {
        let mut near = [Neighbor::EMPTY; 5];
        let (point, scratch) = (kind.point(), &mut scratch[..entries(round)]);
        let found = model.nearest(point, &mut near, budget, scratch)?;
        kind.words(&[0, found.stored as u32, ended(found.ended)]);
        kind.floats(&[found.rest_lower]);
        kind.work(found.work);
        for near in &near[..found.stored] {
            kind.interval(near.distance());
            kind.floats(&near.point());
            kind.words(&[near.triangle()]);
        }
        Ok(())
    })?;
    Ok(closest + &signed + &winding + &within + &nearest)
}

fn segments(model: &Bvh<'_>) -> Result<String, QueryError> {
    rounds("first_hit", |kind, round, budget, scratch| {
        let facing = [Facing::Both, Facing::Front, Facing::Back, Facing::Both][round % 4];
        let (a, b, scratch) = (kind.point(), kind.point(), &mut scratch[..entries(round)]);
        kind.words(&[0]);
        kind.first_hit(&model.first_hit(a, b, facing, budget, scratch)?);
        Ok(())
    })
}

fn rays(model: &Bvh<'_>) -> Result<String, QueryError> {
    rounds("first_hit_of_ray", |kind, round, budget, scratch| {
        let facing = [Facing::Both, Facing::Front, Facing::Back, Facing::Both][round % 4];
        let (a, way, scratch) = (kind.point(), kind.point(), &mut scratch[..entries(round)]);
        kind.words(&[0]);
        kind.first_hit(&model.first_hit_of_ray(a, way, facing, budget, scratch)?);
        Ok(())
    })
}

fn moved_solids(model: &Bvh<'_>) -> Result<String, QueryError> {
    rounds("first_contact", |kind, round, budget, scratch| {
        let [from, to] = [(); 2].map(|()| [kind.point(), kind.point()]);
        let (from, to) = (Solid::new(&from, 1.5)?, Solid::new(&to, 1.5)?);
        let scratch = &mut scratch[..entries(round)];
        kind.words(&[0]);
        kind.first_hit(&model.solid_first_contact(&from, &to, budget, scratch)?);
        Ok(())
    })
}

fn walks(model: &Bvh<'_>) -> Result<String, QueryError> {
    let (mut hint, mut place) = (Hint::NONE, None);
    let from_hints = rounds("closest_point_from", |kind, round, budget, scratch| {
        let here = place.get_or_insert_with(|| kind.point());
        kind.step(here);
        let scratch = &mut scratch[..entries(round)];
        let near = model.closest_point_from(*here, &mut hint, budget, scratch)?;
        kind.words(&[0]);
        kind.closest(&near);
        Ok(())
    })?;
    let (mut query, mut place) = (CoherentQuery::<128>::new(), None);
    let coherent = rounds("coherent", |kind, round, budget, scratch| {
        let here = place.get_or_insert_with(|| kind.point());
        kind.step(here);
        let scratch = &mut scratch[..entries(round)];
        let found = query.closest_point(model, *here, budget, scratch)?;
        kind.words(&[0]);
        kind.closest(&found.closest);
        kind.floats(&[found.safe_radius]);
        Ok(())
    })?;
    Ok(from_hints + &coherent)
}

/// C has these models at one address, Rust at three.
fn a_replaced_model(groove: &[u8]) -> Result<String, Box<dyn std::error::Error>> {
    let blobs = [1, 2, 3].map(|moves| {
        let mut blob = groove.to_vec();
        let origin = entry(&blob, BOX_TREE).offset as usize + GRID_ORIGIN;
        let x = word(&blob, origin).unwrap_or(0);
        put_u32(&mut blob, origin, x + moves * 16_384);
        seal(&mut blob);
        blob
    });
    let (mut query, mut kind) = (CoherentQuery::<128>::new(), Kind::begin());
    let mut scratch = Scratch::<SCRATCH>::new();
    let mut place = kind.point();
    for blob in &blobs {
        let model = Bvh::open(blob)?;
        kind.words(&[0]);
        for _ in 0..ROUNDS / 3 {
            kind.step(&mut place);
            let found = query.closest_point(&model, place, Budget::EXACT, &mut scratch)?;
            kind.words(&[0]);
            kind.closest(&found.closest);
            kind.floats(&[found.safe_radius]);
        }
    }
    Ok(kind.line("replaced"))
}

fn two_models(model: &Bvh<'_>) -> Result<String, QueryError> {
    let overlap = rounds("overlap", |kind, round, budget, scratch| {
        let (pose, scratch) = (kind.pose(round), &mut scratch[..entries(round)]);
        let found = model.overlap(model, pose, budget, scratch)?;
        kind.words(&[0]);
        kind.within_of(&found);
        Ok(())
    })?;
    let within = rounds("within_of", |kind, round, budget, scratch| {
        let (pose, scratch) = (kind.affine(round), &mut scratch[..entries(round)]);
        kind.words(&[0]);
        kind.within_of(&model.within_of(model, pose, 4.0, budget, scratch)?);
        Ok(())
    })?;
    let distance = some_rounds(PAIR_ROUNDS, "distance", |kind, round, budget, scratch| {
        let (pose, scratch) = (kind.affine(round), &mut scratch[..entries(round)]);
        kind.words(&[0]);
        kind.pair_distance(&model.distance_to(model, pose, budget, scratch)?);
        Ok(())
    })?;
    let (mut pair, mut place) = (CoherentPair::<256>::new(), None);
    let coherent = some_rounds(PAIR_ROUNDS, "coherent_pair", |kind, round, budget, scratch| {
        let here = place.get_or_insert_with(|| kind.point());
        kind.step(here);
        let pose = Pose { translation: *here, ..Pose::IDENTITY };
        let scratch = &mut scratch[..entries(round)];
        kind.words(&[0]);
        kind.pair_distance(&pair.distance(model, model, pose, budget, scratch)?);
        kind.words(&[0]);
        kind.within_of(&pair.within(model, model, pose, 30.0, budget, scratch)?);
        Ok(())
    })?;
    let contact = some_rounds(PAIR_ROUNDS, "first_contact_of", |kind, round, budget, scratch| {
        let (from, to) = (kind.pose(round), kind.pose(0));
        let motion = if round % 4 < 2 {
            Motion::straight(from, Pose { translation: to.translation, ..from })
        } else {
            Motion::screw(from, to)?
        };
        let scratch = &mut scratch[..entries(round)];
        let found = model.first_contact_of(model, &motion, 1.0, budget, scratch)?;
        kind.words(&[0, if found.is_clear() { 2 } else { 0 }]);
        kind.floats(&[found.clear_until]);
        kind.floats(found.points.as_flattened());
        kind.words(&found.triangles);
        kind.words(&[ended(found.ended)]);
        kind.work(found.work);
        Ok(())
    })?;
    Ok(overlap + &within + &distance + &coherent + &contact)
}

/// Three copies of a model: one stands, one walks, one stands far away from time to time.
fn scene(model: &Bvh<'_>) -> Result<String, QueryError> {
    let (mut kind, mut scratch) = (Kind::begin(), Scratch::<SCRATCH>::new());
    let mut poses = [0, 1, 2].map(|round| kind.pose(round));
    let [one, two, three] = poses.map(|pose| PlacedModel::new(*model, pose));
    let pairs = [([0, 1], 4.0), ([2, 1], 8.0)];
    let pairs = pairs.map(|(models, distance)| KeptPair { models, distance });
    let mut scene = CoherentScene::new([one?, two?, three?], pairs)?;
    kind.words(&[0]);
    for round in 0..ROUNDS {
        kind.step(&mut poses[1].translation);
        scene.move_to(1, poses[1])?;
        kind.words(&[0]);
        if round % 8 == 7 {
            poses[2] = kind.pose(round);
            scene.move_to(2, poses[2])?;
            kind.words(&[0]);
            poses[1] = kind.pose(round);
        }
        if round % 16 == 15 {
            scene.reset();
            kind.words(&[0]);
        }
        let found = scene.within(budget(round), &mut scratch[..entries(round)])?;
        kind.words(&[0]);
        kind.verdict(found.verdict);
        kind.words(&found.witness.map_or([u32::MAX; 2], |pair| pair.map(|index| index as u32)));
        kind.work(found.work);
    }
    Ok(kind.line("scene"))
}

fn poses() -> Result<String, QueryError> {
    let mut kind = Kind::begin();
    let mut world = RoundedPose::exact(kind.pose(0));
    for _ in 0..ROUNDS {
        let ([x, y, z], translation) = (kind.point(), kind.point());
        let link = Pose::of_quaternion([x, y, z, 1.0], translation)?;
        world = link.then(&world);
        let seen = world.relative_to(&link)?;
        for pose in [link, world, link.inverse()?, seen] {
            kind.words(&[0]);
            kind.floats(pose.pose.rotation.as_flattened());
            kind.floats(&pose.pose.translation);
            kind.words(&[u32::from(pose.pose.is_affine)]);
            kind.floats(&[pose.turn, pose.shift]);
        }
        kind.words(&[0]);
        kind.floats(&[seen.motion(32.0)]);
    }
    Ok(kind.line("poses"))
}

fn triboxes(torus: &[u8]) -> Result<String, Box<dyn std::error::Error>> {
    let part = Triboxes::open(torus)?;
    let (mut kind, mut scratch) = (Kind::begin(), Scratch::<SCRATCH>::new());
    kind.words(&[0, part.separation_entries(&part) as u32]);
    for round in 0..ROUNDS {
        let mut pose = kind.pose(round);
        pose.translation = pose.translation.map(|x| x / 16.0);
        let (budget, scratch) = (budget(round), &mut scratch[..entries(round)]);
        let clear = |is_apart: bool| if is_apart { 2 } else { 0 };
        let node = |pair: NodePair| u32::from(pair.a) | u32::from(pair.b) << 16;
        let apart = part.separation(&part, pose, budget, scratch)?;
        for found in [apart, part.within_of(&part, pose, 4.0, budget, scratch)?] {
            kind.words(&[0, clear(found.is_apart()), ended(found.ended)]);
            kind.words(&[found.may_meet.map_or(0, node)]);
            kind.work(found.work);
        }
        let mut pairs = [NodePair::EMPTY; 16];
        let found = part.candidates(&part, pose, &mut pairs, budget, scratch)?;
        kind.words(&[0, clear(found.is_apart()), ended(found.ended)]);
        kind.words(&[found.stored as u32, found.dropped]);
        kind.work(found.work);
        pairs[..found.stored].iter().for_each(|pair| kind.words(&[node(*pair)]));
        let (a, b) = (kind.point(), kind.point());
        for found in [part.distance(a, budget, scratch)?, part.clip(a, b, budget, scratch)?] {
            kind.words(&[0]);
            kind.floats(&[found.lower]);
            kind.words(&[found.node.unwrap_or(u32::MAX), ended(found.ended)]);
            kind.work(found.work);
        }
    }
    Ok(kind.line("triboxes"))
}

fn distance_field(field: &[u8]) -> Result<String, Box<dyn std::error::Error>> {
    let field = Sdf::open(field)?;
    let mut kind = Kind::begin();
    kind.words(&[0, 0]);
    kind.floats(&[field.unit(), 0.0]);
    let told = |kind: &mut Kind, found: &FieldDistance| {
        kind.words(&[0]);
        kind.side(found.side);
        kind.interval(found.distance);
    };
    for _ in 0..ROUNDS {
        let point = kind.point();
        told(&mut kind, &field.distance(point)?);
        let (found, gradient) = field.distance_and_gradient(point)?;
        told(&mut kind, &found);
        kind.floats(&gradient);
        kind.words(&[0]);
        kind.verdict(field.within(point, 8.0)?);
        let place = field.units_of(point);
        kind.words(&[place.map_or(-42i32, |_| 0).cast_unsigned()]);
        // After an error the place is all zeros.
        let place = place.unwrap_or_default();
        kind.words(&place.map(i32::cast_unsigned));
        let found = field.distance_in_units(place)?;
        kind.words(&[0, found.lower.cast_unsigned(), found.upper.cast_unsigned(), 0]);
        kind.words(&field.gradient_in_units(place)?.map(i32::cast_unsigned));
    }
    Ok(kind.line("field"))
}

fn field_first(both: &[u8]) -> Result<String, Box<dyn std::error::Error>> {
    let part = BvhWithSdf::open(both)?;
    let (mut kind, mut memory) = (Kind::begin(), Scratch::<SCRATCH>::new());
    kind.words(&[0, part.tree().scratch_entries() as u32]);
    let coarse = Budget::EXACT.with_relative(0.1).with_absolute(2.0);
    for round in 0..ROUNDS {
        let (point, budget) = (kind.point(), budget(round));
        let scratch = &mut memory[..entries(round)];
        let found = part.within(point, 8.0, budget, scratch)?;
        kind.words(&[0]);
        kind.verdict(found.verdict);
        kind.words(&[found.witness.unwrap_or(u32::MAX)]);
        kind.work(found.work);
        let found = part.distance_bounds(point, coarse, scratch)?;
        kind.words(&[0]);
        kind.interval(found.distance);
        kind.words(&[ended(found.ended)]);
        kind.work(found.work);
        let found = part.signed_bounds(point, coarse, scratch)?;
        kind.words(&[0]);
        kind.side(found.side);
        kind.interval(found.distance);
        kind.words(&[ended(found.ended)]);
        kind.work(found.work);
        let near = part.closest_point(point, coarse, scratch)?;
        kind.words(&[0]);
        kind.closest(&near);
        let moved = [point, point.map(|x| x + 4.0)];
        let ends = [[20.0, 20.0, 50.0], [20.0, 24.0, 55.0]];
        let (from, to) = (Solid::new(&ends, 0.5)?, Solid::new(&moved, 0.5)?);
        kind.words(&[0]);
        kind.first_hit(&part.solid_first_contact(&from, &to, budget, scratch)?);
    }
    Ok(kind.line("field_first"))
}

fn curves(fence: &[u8]) -> Result<String, Box<dyn std::error::Error>> {
    let curve = Curve::open(fence)?;
    let (mut kind, mut scratch) = (Kind::begin(), Scratch::<SCRATCH>::new());
    kind.words(&[0, curve.scratch_entries() as u32, 0]);
    curve.check_fence()?;
    let listed = |kind: &mut Kind, found: &[CurveNeighbor]| {
        for near in found {
            kind.interval(near.distance());
            kind.floats(&near.point());
            kind.words(&[near.segment().polyline, near.segment().segment]);
            kind.floats(&[near.t()]);
        }
    };
    let on_curve = |kind: &mut Kind, near: &CurveClosest| {
        kind.interval(near.distance);
        kind.floats(&near.point);
        kind.words(&[near.segment.polyline, near.segment.segment]);
        kind.floats(&[near.t, near.safe_motion]);
        kind.words(&[ended(near.ended)]);
        kind.work(near.work);
    };
    for round in 0..ROUNDS {
        let (point, scratch) = (kind.point(), &mut scratch[..entries(round)]);
        let [x, y, _] = point;
        let budget = budget(round);
        kind.words(&[0]);
        on_curve(&mut kind, &curve.closest_point(point, budget, scratch)?);
        let found = curve.signed_distance([x, y], budget, scratch)?;
        kind.words(&[0]);
        kind.side(found.side);
        kind.interval(found.distance);
        on_curve(&mut kind, &found.closest);
        let found = curve.within(point, 20.0, budget, scratch)?;
        kind.words(&[0]);
        kind.verdict(found.verdict);
        let place = found.witness.map(|at| [at.polyline, at.segment]);
        kind.words(&place.unwrap_or([u32::MAX; 2]));
        kind.work(found.work);
        let mut near = [CurveNeighbor::EMPTY; 3];
        let found = curve.nearest(point, &mut near, budget, scratch)?;
        kind.words(&[0, found.stored as u32, ended(found.ended)]);
        kind.floats(&[found.rest_lower]);
        kind.work(found.work);
        listed(&mut kind, &near[..found.stored]);
        let found = curve.all_within(point, 30.0, &mut near, budget, scratch)?;
        kind.words(&[0, found.stored as u32, found.certain as u32, found.dropped]);
        kind.words(&[ended(found.ended)]);
        kind.work(found.work);
        listed(&mut kind, &near[..found.stored]);
    }
    Ok(kind.line("curves"))
}

fn tight_hull(hulls: &[u8]) -> Result<String, Box<dyn std::error::Error>> {
    let hulls = TightHulls::open(hulls)?;
    let (mut kind, mut scratch) = (Kind::begin(), Scratch::<SCRATCH>::new());
    for hull in [hulls.get(0), hulls.finest()] {
        let hull = hull.ok_or("no hull")?;
        kind.words(&[0, hull.scratch_entries() as u32]);
        for round in 0..ROUNDS {
            let (point, scratch) = (kind.point(), &mut scratch[..entries(round)]);
            let found = hull.within(point, 20.0, budget(round), scratch)?;
            kind.words(&[0]);
            kind.verdict(found.verdict);
            kind.words(&[found.witness.unwrap_or(u32::MAX)]);
            kind.work(found.work);
        }
    }
    let text = kind.line("tight_within");
    let tree = *hulls.finest().ok_or("no hull")?.bvh();
    let tight = rounds("tight_models", |kind, round, budget, scratch| {
        let (pose, scratch) = (kind.pose(round), &mut scratch[..entries(round)]);
        if round == 0 {
            kind.words(&[0]); // The model is opened.
        }
        kind.words(&[0]);
        kind.within_of(&tree.within_of(&tree, pose, 4.0, budget, scratch)?);
        Ok(())
    })?;
    Ok(text + &tight)
}

fn refined_hull(bracket: &[u8]) -> Result<String, Box<dyn std::error::Error>> {
    let hull = Hull::open(bracket)?;
    let (mut kind, mut refined) = (Kind::begin(), RefinedHull::<SPLITS>::new());
    kind.words(&[0]);
    for number in 0..10 {
        let (a, b, radius) = (kind.point(), kind.point(), 3.0);
        let focus = match number % 5 {
            0 => Focus::Everywhere,
            1 => Focus::Ball { centre: a, radius },
            2 => Focus::Box { a, b },
            3 => Focus::Segment { a, b, radius },
            _ => Focus::Eye { position: a, axis: b, cosine: 0.5, error_per_distance: 0.125 },
        };
        let found = refined.update(&hull, &focus, 0.5, &mut [])?;
        kind.words(&[0, u32::from(found.error_left == 0.0), found.error_left.to_bits()]);
        kind.words(&[found.faces, found.performed, found.undone]);
        let faces: Vec<_> = refined.faces(&hull).collect();
        let stored = faces.len().min(FACES);
        kind.words(&[0, stored as u32, (faces.len() - stored) as u32]);
        for face in &faces[..stored] {
            for corner in face.corners {
                kind.floats(&hull.vertex(corner).ok_or("no such vertex")?);
            }
            kind.floats(&[(f64::from(face.radius) * hull.scale()) as f32]);
        }
    }
    for _ in 0..3 {
        let found = refined.sweep_to(&hull, kind.point(), 4.0)?;
        kind.words(&[0, u32::from(found.error_left == 0.0), found.error_left.to_bits()]);
        kind.words(&[found.faces, found.splits, 0]);
    }
    Ok(kind.line("refine"))
}

/// The numbers of `meshsweep.h`, in the order in which `answers.c` is refused.
fn refusals() -> String {
    let mut kind = Kind::begin();
    let zeros = [0; 11];
    let codes = |kind: &mut Kind, codes: &[i32]| {
        codes.iter().for_each(|code| kind.words(&[code.cast_unsigned()]));
    };
    // NULL four times, misaligned, never opened, no scratch, too much of it, NaN.
    codes(&mut kind, &[-1, -1, -1, -1, -2, -3, -44, -4, -40]);
    kind.words(&zeros);
    // An unknown facing, a pose of zeros, no corner, a radius below 0, no memory of a walk, no
    // hint.
    codes(&mut kind, &[-5, -43, -4, -41, -1, -1]);
    // A blob that is cut short, the model that it left, a blob without a tree, other bytes.
    codes(&mut kind, &[-20, -3, -26, -22]);
    // A hull that was not opened, no such hull, then memory of another count, and too little.
    codes(&mut kind, &[-3, -7, 0, -6, -6]);
    // Scenes: too few entries, no such model, one twice, a distance below 0, a pose of zeros; none
    // in the memory; one; no such model, a pose of zeros, no scratch.
    codes(&mut kind, &[-6, -47, -47, -41, -43, -3, 0, -47, -43, -44]);
    kind.words(&zeros[..8]);
    // A scene, too many entries, none in the memory; a scene, too few entries, none in the memory.
    codes(&mut kind, &[0, -4, -3, 0, -6, -3]);
    // An unknown kind of motion, one of zeros, a blob without triboxes.
    codes(&mut kind, &[-5, -43]);
    kind.words(&[0; 15]);
    codes(&mut kind, &[-26, 0]);
    // Triboxes, and a distance below 0.
    codes(&mut kind, &[0, -41]);
    kind.words(&[0; 7]);
    // A blob without curves, the curves that were not opened.
    codes(&mut kind, &[-26, -3]);
    // A blob without a field, the field that was not opened.
    codes(&mut kind, &[-26, -3]);
    kind.words(&[0; 2]);
    // Meshes that deform: no such frame; nothing begun, twice; too few records, enough; too few
    // vertices, a slack below 0, NaN, a question after it; a blob without one, what it left.
    codes(&mut kind, &[0, -50]);
    kind.words(&zeros);
    codes(&mut kind, &[-3, -3, -6, 0, -4, -41, -42, -51, -26, -3]);
    kind.line("refusals")
}

/// The lines about the committed blobs.
///
/// # Errors
/// A blob that is not there, does not open or refuses a question.
pub fn of_fixtures(folder: &std::path::Path) -> Result<String, String> {
    let read =
        |name: &str| std::fs::read(folder.join(name)).map_err(|error| format!("{name}: {error}"));
    let [groove, hulls, bracket] = [read("groove.msw")?, read("hulls.msw")?, read("bracket.msw")?];
    let [torus, fence] = [read("torus.msw")?, read("fence.msw")?];
    let [field, both, bend] = [read("field.msw")?, read("both.msw")?, read("bend.msw")?];
    lines(&groove, &hulls, &bracket, &torus, &fence, [&field, &both], &bend)
        .map_err(|error| error.to_string())
}
