//! Links: counts, places and shapes of children.

use super::{ask_everything, edited, open, record, sphere};
use meshsweep::bvh::{TreeOptions, build};
use meshsweep::mesh::Mesh;
use meshsweep::progress::Watch;
use meshsweep_core::internal::bvh::tree::format::BvhHeader;
use meshsweep_core::{Bvh, Contradiction, OpenError, SectionKind};
use meshsweep_host_tests::corrupt::{put_u32, word};

/// Bytes of a record.
const LINK: usize = 20;

fn link_word(node: usize, at: usize, change: impl Fn(u32) -> u32) -> Result<(), OpenError> {
    edited(sphere(), SectionKind::TreeLinks, |bytes| {
        let at = LINK * node + at;
        put_u32(bytes, at, change(word(bytes, at).expect("a record")));
    })
}

#[test]
fn counts_of_children_out_of_range_name_the_node() {
    let bytes = sphere();
    let nodes = Bvh::open(&bytes).expect("opens").header().nodes;
    for node in 0..nodes {
        let named = record(SectionKind::TreeLinks, node);
        let with = |inner: u32, count: u32| {
            link_word(node as usize, 0, |word| word & 0xFF_FFFF | inner << 24 | count << 28)
        };
        for (inner, count) in [(0, 0), (0, 9), (15, 15), (2, 1), (8, 7)] {
            assert_eq!(with(inner, count), named, "{inner} of {count}");
        }
    }
}

#[test]
fn links_that_lead_elsewhere_name_the_node() {
    let bytes = sphere();
    let tree = Bvh::open(&bytes).expect("opens");
    let header = *tree.header();
    let (mut inner, mut leaves) = (0, 0);
    for node in 0..header.nodes {
        let links = tree.links(node).expect("a node");
        let named = record(SectionKind::TreeLinks, node);
        if links.inner > 0 {
            inner += 1;
            // Its parent, itself, its own child again, and past the end: cycles, second parents,
            // nothing.
            for first in
                [0, node, links.first_node + 1, links.first_node - 1, header.nodes, 0xFF_FFFF]
            {
                let result = link_word(node as usize, 0, |word| word & 0xFF00_0000 | first);
                assert_eq!(result, named, "node {node} with first child {first}");
            }
        }
        if links.count > links.inner {
            leaves += 1;
            for (at, stored) in [(4, links.first_vertex), (8, links.first_triangle)] {
                for value in [stored + 1, stored.wrapping_sub(1), 0x00FF_FFFF, u32::MAX] {
                    assert_eq!(link_word(node as usize, at, |_| value), named, "{value} at {at}");
                }
            }
        }
    }
    assert!(inner >= 1 && leaves > 4);
}

#[test]
fn tags_of_no_shape_name_the_node() {
    let bytes = sphere();
    let tree = Bvh::open(&bytes).expect("opens");
    let tag = |node: u32, lane: u32, tag: u8| {
        edited(sphere(), SectionKind::TreeLinks, |bytes| {
            bytes[LINK * node as usize + 12 + lane as usize] = tag;
        })
    };
    for node in 0..tree.header().nodes {
        let links = tree.links(node).expect("a node");
        let named = record(SectionKind::TreeLinks, node);
        for lane in 0..8 {
            if lane < links.inner || lane >= links.count {
                assert_eq!(tag(node, lane, 0x05), named, "a shape for what is no leaf");
            } else {
                // No vertices, no triangle, nine of them, a second fan that begins past the end,
                // one reversed that is not there.
                for bad in [0x00, 0x01, 0x02, 0x0B, 0x13, 0x0F, 0x75, 0x85] {
                    assert_eq!(tag(node, lane, bad), named, "tag {bad:#x}");
                }
            }
        }
    }
}

/// One triangle below a chain of so many nodes.
fn chain(nodes: usize) -> Vec<u8> {
    let mesh = Mesh::new(vec![[0.0, 0.0, 0.0], [1.0, 0.5, 0.0], [0.0, 1.0, 0.25]], vec![[0, 1, 2]]);
    let (mut tables, report) =
        build(mesh.as_input(), &TreeOptions::default(), Watch::NONE).expect("builds");
    let header = BvhHeader { nodes: nodes as u32, ..report.header };
    for (kind, bytes) in &mut tables.bodies {
        let one = bytes.clone();
        match kind {
            SectionKind::Bvh => *bytes = header.write().to_vec(),
            SectionKind::TreeLinks => {
                let mut last = one;
                let inner = |node: u32| ((node + 1) | 1 << 24 | 1 << 28).to_le_bytes();
                *bytes = Vec::new();
                for node in 1..nodes as u32 {
                    bytes.extend(inner(node - 1));
                    bytes.extend([0; LINK - 4]);
                }
                bytes.append(&mut last);
            }
            SectionKind::TreeFrames | SectionKind::TreeBoxes => *bytes = one.repeat(nodes),
            _ => {}
        }
    }
    tables.to_bytes()
}

#[test]
fn a_tree_of_64_nodes_on_a_path_opens_and_a_deeper_one_is_refused() {
    let bytes = chain(64);
    let tree = Bvh::open(&bytes).expect("deep, but not too deep");
    ask_everything(&tree, false);
    let result = open(&chain(65));
    assert!(
        matches!(result, Err(OpenError::Counts { what: Contradiction::TreeDepth })),
        "{result:?}"
    );
}
