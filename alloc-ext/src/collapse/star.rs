//! Connectivity of a closed manifold mesh under edge collapse. It knows no positions.

use arrayvec::ArrayVec;

/// Most triangles of an edge's star.
pub const MAX_STAR: usize = 64;

/// Triangles and the triangles at each vertex.
#[derive(Clone, Debug)]
pub struct Connectivity {
    /// Corners, counter-clockwise; meaningless once dead.
    pub corners: Vec<[u32; 3]>,
    alive: Vec<bool>,
    at_vertex: Vec<Vec<u32>>,
    alive_count: usize,
    mark: Vec<u32>,
    stamp: u32,
}

impl Connectivity {
    /// From triangles of a closed manifold with consistent winding.
    pub fn new(vertices: usize, triangles: &[[u32; 3]]) -> Self {
        let mut counts = vec![0usize; vertices];
        triangles.iter().flatten().for_each(|&v| counts[v as usize] += 1);
        let mut at_vertex: Vec<Vec<u32>> = counts.into_iter().map(Vec::with_capacity).collect();
        for (index, corners) in triangles.iter().enumerate() {
            corners.iter().for_each(|&v| at_vertex[v as usize].push(index as u32));
        }
        Connectivity {
            corners: triangles.to_vec(),
            alive: vec![true; triangles.len()],
            at_vertex,
            alive_count: triangles.len(),
            mark: vec![0; vertices],
            stamp: 0,
        }
    }

    /// Triangles left.
    pub fn alive_count(&self) -> usize {
        self.alive_count
    }

    /// Whether a triangle is left.
    pub fn is_alive(&self, triangle: u32) -> bool {
        self.alive[triangle as usize]
    }

    /// Numbers of the triangles that are left.
    pub fn alive(&self) -> impl Iterator<Item = u32> + '_ {
        (0..self.corners.len() as u32).filter(|&t| self.is_alive(t))
    }

    /// Each edge that is left once, lesser end first, in the order of the triangles.
    pub fn edges(&self) -> Vec<[u32; 2]> {
        let edges = self.alive().flat_map(|t| {
            let [a, b, c] = self.corners[t as usize];
            [[a, b], [b, c], [c, a]]
        });
        edges.filter(|[a, b]| a < b).collect()
    }

    /// Triangles at a vertex, in no order; none once it was collapsed away.
    #[inline]
    pub fn at(&self, vertex: u32) -> &[u32] {
        &self.at_vertex[vertex as usize]
    }

    /// The vertex after `vertex` in a triangle.
    #[inline]
    pub fn next_in(&self, triangle: u32, vertex: u32) -> u32 {
        let [a, b, c] = self.corners[triangle as usize];
        if a == vertex {
            b
        } else if b == vertex {
            c
        } else {
            a
        }
    }

    /// Neighbours of a vertex: each stands once, as the mesh is closed and consistently wound.
    pub fn neighbours(&self, vertex: u32) -> impl Iterator<Item = u32> + '_ {
        self.at(vertex).iter().map(move |&t| self.next_in(t, vertex))
    }

    /// Puts the triangles of edge `a b`'s star into `star`. True if collapsing the edge keeps the
    /// mesh manifold (link condition, Dey et al. 1999) and the valence in bounds; otherwise `star`
    /// is incomplete.
    #[inline]
    pub fn collapsible_star(
        &mut self,
        a: u32,
        b: u32,
        max_valence: usize,
        star: &mut Vec<u32>,
    ) -> bool {
        self.stamp += 1;
        let stamp = self.stamp;
        let (at_a, at_b) = (&self.at_vertex[a as usize], &self.at_vertex[b as usize]);
        let total = at_a.len() + at_b.len();
        // Both ends count their two shared triangles. A closed mesh of four triangles cannot
        // collapse further.
        if total < 7 || total - 4 > max_valence || total - 2 > MAX_STAR {
            return false;
        }
        star.clear();
        let mut shared = 0;
        for &t in at_a {
            let corners = self.corners[t as usize];
            corners.iter().for_each(|&v| self.mark[v as usize] = stamp);
            shared += usize::from(corners.contains(&b));
            star.push(t);
        }
        let mut common = 0;
        for &t in at_b {
            let corners = self.corners[t as usize];
            if !corners.contains(&a) {
                star.push(t);
            }
            let [p, q, r] = corners;
            let next = if p == b {
                q
            } else if q == b {
                r
            } else {
                p
            };
            common += usize::from(next != a && self.mark[next as usize] == stamp);
        }
        shared == 2 && common == 2
    }

    /// The ring of edge `a b`: its link, counter-clockwise, from the left wing (apex of the
    /// triangle on the left of `a → b`), the triangle at each ring edge, and the position of
    /// the right wing.
    pub fn ring(&self, a: u32, b: u32) -> Option<Ring> {
        let left = self.apex(a, b)?;
        let right = self.apex(b, a)?;
        let mut ring = Ring { vertices: ArrayVec::new(), triangles: ArrayVec::new(), right: 0 };
        // Around `a` from the left wing to the right wing, then around `b` back.
        for (centre, from, to) in [(a, left, right), (b, right, left)] {
            if centre == b {
                ring.right = ring.vertices.len();
            }
            let mut current = from;
            while current != to {
                let triangle = self.leaving(centre, current)?;
                ring.vertices.try_push(current).ok()?;
                ring.triangles.try_push(triangle).ok()?;
                let next = self.next_in(triangle, current);
                current = next;
            }
        }
        Some(ring)
    }

    /// Third corner of the triangle that has the directed edge `from → to`.
    fn apex(&self, from: u32, to: u32) -> Option<u32> {
        let triangle = self.leaving(from, to)?;
        Some(self.next_in(triangle, to))
    }

    /// The triangle that has the directed edge `from → to`.
    pub fn leaving(&self, from: u32, to: u32) -> Option<u32> {
        self.at(from).iter().copied().find(|&t| self.next_in(t, from) == to)
    }

    /// Collapses edge `a b` into `a`. The caller has checked
    /// [`collapsible_star`](Self::collapsible_star).
    pub fn collapse(&mut self, a: u32, b: u32) {
        for t in std::mem::take(&mut self.at_vertex[b as usize]) {
            let corners = self.corners[t as usize];
            if corners.contains(&a) {
                self.alive[t as usize] = false;
                self.alive_count -= 1;
                for v in corners {
                    if v != b {
                        self.at_vertex[v as usize].retain(|&x| x != t);
                    }
                }
            } else {
                for corner in &mut self.corners[t as usize] {
                    if *corner == b {
                        *corner = a;
                    }
                }
                self.at_vertex[a as usize].push(t);
            }
        }
    }

    /// Flips the edge `a b` between the triangles `a b c` and `b a d`: they become `a d c` and `d b
    /// c`, in their old places, which are returned with `c` and `d`. `None`, and nothing
    /// changes, if an end would be left with fewer than three triangles or there is an edge `c d`.
    pub fn flip(&mut self, a: u32, b: u32) -> Option<Wings> {
        let wings = self.wings(a, b)?;
        let Wings { triangles: [f, g], apexes: [c, d] } = wings;
        let is_edge = c == d || self.neighbours(c).any(|v| v == d);
        if is_edge || self.at(a).len() <= 3 || self.at(b).len() <= 3 {
            return None;
        }
        self.corners[f as usize] = [a, d, c];
        self.corners[g as usize] = [d, b, c];
        self.at_vertex[a as usize].retain(|&t| t != g);
        self.at_vertex[b as usize].retain(|&t| t != f);
        self.at_vertex[c as usize].push(g);
        self.at_vertex[d as usize].push(f);
        Some(wings)
    }

    /// Puts a new vertex, which is returned, on the edge `a b`: the reverse of a collapse with four
    /// triangles in the star. The new triangles are the last two.
    pub fn split(&mut self, a: u32, b: u32) -> Option<u32> {
        let Wings { triangles: [f, g], apexes: [c, d] } = self.wings(a, b)?;
        let v = self.at_vertex.len() as u32;
        let h = self.corners.len() as u32;
        self.corners[f as usize] = [v, c, a];
        self.corners[g as usize] = [v, a, d];
        self.corners.extend([[v, b, c], [v, d, b]]);
        self.alive.extend([true, true]);
        self.alive_count += 2;
        self.mark.push(0);
        self.at_vertex.push(vec![f, g, h, h + 1]);
        self.at_vertex[b as usize].retain(|&t| t != f && t != g);
        self.at_vertex[b as usize].extend([h, h + 1]);
        self.at_vertex[c as usize].push(h);
        self.at_vertex[d as usize].push(h + 1);
        Some(v)
    }

    /// The triangles on both sides of an edge.
    pub fn wings(&self, a: u32, b: u32) -> Option<Wings> {
        let triangles = [self.leaving(a, b)?, self.leaving(b, a)?];
        let apexes = [self.next_in(triangles[0], b), self.next_in(triangles[1], a)];
        Some(Wings { triangles, apexes })
    }
}

/// The two sides of an edge `a b`, the left one first.
#[derive(Clone, Copy, Debug)]
pub struct Wings {
    /// The triangle of `a b`, and that of `b a`.
    pub triangles: [u32; 2],
    /// Their third corners.
    pub apexes: [u32; 2],
}

/// The link of an edge.
#[derive(Clone, Debug)]
pub struct Ring {
    /// Vertices, counter-clockwise.
    pub vertices: ArrayVec<u32, MAX_STAR>,
    /// Triangle at ring edge `i → i + 1`.
    pub triangles: ArrayVec<u32, MAX_STAR>,
    /// Position of the right wing.
    pub right: usize,
}
