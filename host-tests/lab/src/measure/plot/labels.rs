//! Where labels go: beside their points, upon nothing.

/// A rectangle in pixels, y downward.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rect {
    /// Left, top.
    pub low: [f64; 2],
    /// Right, bottom.
    pub high: [f64; 2],
}

impl Rect {
    /// About a point.
    pub fn about([x, y]: [f64; 2], reach: f64) -> Self {
        Self { low: [x - reach, y - reach], high: [x + reach, y + reach] }
    }

    /// The area that both have.
    pub fn shared(&self, other: &Self) -> f64 {
        let along =
            |k: usize| (self.high[k].min(other.high[k]) - self.low[k].max(other.low[k])).max(0.0);
        along(0) * along(1)
    }

    fn area(&self) -> f64 {
        (self.high[0] - self.low[0]) * (self.high[1] - self.low[1])
    }

    /// Its point nearest to another.
    pub fn nearest(&self, p: [f64; 2]) -> [f64; 2] {
        [0, 1].map(|k| p[k].clamp(self.low[k], self.high[k]))
    }

    /// From a point.
    pub fn distance(&self, p: [f64; 2]) -> f64 {
        let near = self.nearest(p);
        (near[0] - p[0]).hypot(near[1] - p[1])
    }
}

/// Between two labels.
const GAP: f64 = 2.0;
/// From a point to where its label may begin, nearest first.
const DISTANCES: [f64; 9] = [8.0, 13.0, 20.0, 30.0, 42.0, 58.0, 78.0, 100.0, 130.0];
/// Directions, the most natural first: a label right of its point reads best.
const DIRECTIONS: [[f64; 2]; 12] = [
    [1.0, 0.0],
    [-1.0, 0.0],
    [0.0, -1.0],
    [0.0, 1.0],
    [0.7, -0.7],
    [0.7, 0.7],
    [-0.7, -0.7],
    [-0.7, 0.7],
    [0.9, -0.4],
    [0.9, 0.4],
    [-0.9, -0.4],
    [-0.9, 0.4],
];
/// What it is worth that a label touches another or a point, in pixels of distance.
const TOUCHED: f64 = 1000.0;
/// What a pixel is worth that lies on another label, on a point or outside, on a line.
const ON_LABEL: f64 = 100.0;
const ON_POINT: f64 = 50.0;
const ON_LINE: f64 = 1.0;
/// The same of a label's line that crosses another's.
const ACROSS: f64 = 20.0;
/// What it is worth that a label seems to be another point's: that is hardly farther away.
const MISREAD: f64 = 40.0;
const HARDLY: f64 = 5.0;
/// How often labels choose again, knowing where the others are.
const ROUNDS: usize = 8;

/// A place for each label, `sizes` of which belong to `points`: within `frame`, off points, other
/// labels and, if it can be, lines, as near as that allows. Earlier points choose first.
pub fn place(
    frame: &Rect,
    points: &[[f64; 2]],
    sizes: &[[f64; 2]],
    marker: f64,
    lines: &[[[f64; 2]; 2]],
) -> Vec<Rect> {
    let markers: Vec<Rect> = points.iter().map(|p| Rect::about(*p, marker)).collect();
    let on_lines: Vec<Rect> = lines.iter().flat_map(|[from, to]| beads(*from, *to)).collect();
    let mut placed: Vec<Option<Rect>> = vec![None; points.len()];
    for _ in 0..ROUNDS {
        for (own, (&point, &size)) in points.iter().zip(sizes).enumerate() {
            let others = || (0..points.len()).filter(|other| *other != own);
            let labels: Vec<Rect> = others().filter_map(|other| placed[other]).collect();
            let leaders = others().filter_map(|other| {
                Some(beads(points[other], placed[other]?.nearest(points[other])))
            });
            let leaders: Vec<Rect> = leaders.flatten().collect();
            let price = |place: &Rect, far: f64| {
                let wide =
                    Rect { low: place.low.map(|x| x - GAP), high: place.high.map(|x| x + GAP) };
                let leader = beads(point, place.nearest(point));
                let on = |all: &[Rect]| all.iter().map(|other| wide.shared(other)).sum::<f64>();
                let crossed = |all: &Rect| leader.iter().map(|bead| bead.shared(all)).sum::<f64>();
                let outside = wide.area() - wide.shared(frame);
                let misread = others()
                    .filter(|other| {
                        place.distance(points[*other]) <= place.distance(point) + HARDLY
                    })
                    .count();
                // However little it is.
                let touched =
                    labels.iter().chain(&markers).filter(|other| wide.shared(other) > 0.0).count();
                let on_points = on(&markers)
                    + outside
                    + others().map(|other| crossed(&markers[other])).sum::<f64>();
                ON_LABEL * (on(&labels) + labels.iter().map(crossed).sum::<f64>())
                    + ON_POINT * on_points
                    + ON_LINE * (on(&on_lines) + on(&leaders))
                    + ACROSS * leaders.iter().map(crossed).sum::<f64>()
                    + MISREAD * misread as f64
                    + TOUCHED * touched as f64
                    + far
            };
            let choices = DISTANCES.iter().flat_map(|&far| {
                let ways = DIRECTIONS.iter().enumerate();
                ways.map(move |(rank, &way)| {
                    (beside(point, size, way, far), far + 0.1 * rank as f64)
                })
            });
            let priced = choices.map(|(place, far)| (price(&place, far), place));
            placed[own] = priced.min_by(|(a, _), (b, _)| a.total_cmp(b)).map(|(_, place)| place);
        }
    }
    placed
        .into_iter()
        .zip(points)
        .map(|(place, point)| place.unwrap_or(Rect::about(*point, 0.0)))
        .collect()
}

/// A label whose edge or corner is `far` from the point in that direction.
fn beside(point: [f64; 2], size: [f64; 2], way: [f64; 2], far: f64) -> Rect {
    let start = |k: usize| {
        let anchor = point[k] + way[k] * far;
        // Its middle if the direction is across, its near end if not.
        anchor
            - size[k]
                * if way[k] == 0.0 {
                    0.5
                } else if way[k] < 0.0 {
                    1.0
                } else {
                    0.0
                }
    };
    // Beside a point to the right or left, the text's middle is level with it however steep the way
    // is.
    let low = [
        start(0),
        if way[0].abs() > way[1].abs() {
            point[1] + way[1] * far - 0.5 * size[1]
        } else {
            start(1)
        },
    ];
    Rect { low, high: [low[0] + size[0], low[1] + size[1]] }
}

/// Small squares along a line: what it covers.
fn beads(from: [f64; 2], to: [f64; 2]) -> Vec<Rect> {
    let length = (to[0] - from[0]).hypot(to[1] - from[1]);
    let count = (length / 3.0).ceil().max(1.0) as usize;
    let at = |step: usize| [0, 1].map(|k| from[k] + (to[k] - from[k]) * step as f64 / count as f64);
    (0..=count).map(|step| Rect::about(at(step), 1.5)).collect()
}

#[cfg(test)]
mod tests {
    use super::{Rect, place};
    use meshsweep_host_tests::generate::Rng;

    #[test]
    fn labels_of_a_crowd_are_in_the_frame_and_on_nothing() {
        let frame = Rect { low: [0.0; 2], high: [600.0, 400.0] };
        let mut rng = Rng::new(1999);
        for crowd in [1, 5, 18] {
            for _ in 0..20 {
                let points: Vec<[f64; 2]> = (0..crowd)
                    .map(|_| [150.0 + 300.0 * rng.unit_f64(), 100.0 + 150.0 * rng.unit_f64()])
                    .collect();
                let sizes: Vec<[f64; 2]> =
                    (0..crowd).map(|_| [30.0 + 80.0 * rng.unit_f64(), 12.0]).collect();
                let labels = place(&frame, &points, &sizes, 4.0, &[]);
                for (k, label) in labels.iter().enumerate() {
                    assert!((frame.shared(label) - label.area()).abs() < 1e-6);
                    assert!((label.area() - sizes[k][0] * sizes[k][1]).abs() < 1e-6);
                    assert!(points.iter().all(|p| label.shared(&Rect::about(*p, 4.0)) == 0.0));
                    assert!(label.distance(points[k]) < 200.0);
                    assert!(labels[..k].iter().all(|other| label.shared(other) == 0.0));
                }
            }
        }
    }

    #[test]
    fn a_lone_label_is_right_of_its_point_and_one_at_the_right_edge_left_of_it() {
        let frame = Rect { low: [0.0; 2], high: [200.0, 100.0] };
        let labels = place(&frame, &[[50.0, 50.0], [190.0, 20.0]], &[[40.0, 10.0]; 2], 4.0, &[]);
        assert_eq!(labels[0], Rect { low: [58.0, 45.0], high: [98.0, 55.0] });
        assert_eq!(labels[1], Rect { low: [142.0, 15.0], high: [182.0, 25.0] });
    }
}
