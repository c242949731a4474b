//! Bounding volume hierarchy of a triangle mesh, built by the surface area heuristic in bins.
//!
//! Nodes lie in one array, children next to each other, triangles in the order of the leaves: a query walks forward in
//! memory. Splits depend on coordinates and, where these are equal, on indices only, so that the same mesh gives the
//! same tree. Exact splits would make queries some percent faster and the build several times slower.

use glam::DVec3;

use crate::{Aabb, MeshError, TriangleMesh};

const BINS: usize = 16;
const LEAF_SIZE: usize = 4;

/// The tree, with a copy of the triangles in leaf order.
#[derive(Debug, Clone)]
pub struct Bvh {
    pub(crate) nodes: Vec<Node>,
    pub(crate) corners: Vec<[DVec3; 3]>,
    pub(crate) triangle_of_slot: Vec<u32>,
}

/// A box with two children (`first`, `first + 1`) or, where `count` > 0, with the triangles in slots `first` onwards.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Node {
    pub bounds: Aabb,
    pub first: u32,
    pub count: u32,
}

impl Bvh {
    /// Builds the tree in O(n log n).
    ///
    /// # Errors
    /// A mesh without triangles.
    pub fn new(mesh: &TriangleMesh) -> Result<Self, MeshError> {
        if mesh.triangles().is_empty() {
            return Err(MeshError::Empty);
        }
        let mut items: Vec<Item> = (0..mesh.triangles().len()).map(|t| Item::new(mesh, t)).collect();
        let mut nodes = vec![Node { bounds: bounds_of(&items), first: 0, count: 0 }];
        split(&mut nodes, 0, &mut items, 0);
        let triangle_of_slot: Vec<u32> = items.iter().map(|item| item.triangle).collect();
        let corners = triangle_of_slot.iter().map(|&t| mesh.corners(t as usize)).collect();
        Ok(Self { nodes, corners, triangle_of_slot })
    }

    /// The box around the mesh.
    pub fn bounds(&self) -> Aabb {
        self.nodes[0].bounds
    }

    /// Slots of a leaf's triangles; none for an inner node.
    pub(crate) fn slots(node: &Node) -> std::ops::Range<usize> {
        node.first as usize..(node.first + node.count) as usize
    }
}

struct Item {
    bounds: Aabb,
    centre: DVec3,
    triangle: u32,
}

impl Item {
    fn new(mesh: &TriangleMesh, triangle: usize) -> Self {
        let bounds = Aabb::of(&mesh.corners(triangle));
        Self { bounds, centre: bounds.centre(), triangle: triangle as u32 }
    }
}

fn bounds_of(items: &[Item]) -> Aabb {
    items.iter().fold(Aabb::EMPTY, |b, item| b.union(item.bounds))
}

fn split(nodes: &mut Vec<Node>, node: usize, items: &mut [Item], first_slot: usize) {
    let middle = if items.len() <= LEAF_SIZE { None } else { partition(items) };
    let Some(middle) = middle else {
        nodes[node].first = first_slot as u32;
        nodes[node].count = items.len() as u32;
        return;
    };
    let children = nodes.len();
    nodes[node].first = children as u32;
    let (left, right) = items.split_at_mut(middle);
    nodes.push(Node { bounds: bounds_of(left), first: 0, count: 0 });
    nodes.push(Node { bounds: bounds_of(right), first: 0, count: 0 });
    split(nodes, children, left, first_slot);
    split(nodes, children + 1, right, first_slot + middle);
}

/// Orders the items into two groups and gives the size of the first; halves by index where all centres coincide.
fn partition(items: &mut [Item]) -> Option<usize> {
    let centres = items.iter().fold(Aabb::EMPTY, |b, item| b.with(item.centre));
    let extent = centres.max - centres.min;
    let axis = if extent.x >= extent.y && extent.x >= extent.z {
        0
    } else if extent.y >= extent.z {
        1
    } else {
        2
    };
    if extent[axis] <= 0.0 {
        return Some(items.len() / 2);
    }
    let scale = BINS as f64 / extent[axis];
    let bin_of = |item: &Item| (((item.centre[axis] - centres.min[axis]) * scale) as usize).min(BINS - 1);
    let border = best_border(items, bin_of);
    items.sort_by_key(|item| (bin_of(item) >= border, item.triangle));
    let middle = items.partition_point(|item| bin_of(item) < border);
    (middle > 0 && middle < items.len()).then_some(middle)
}

/// First bin of the right-hand group, at the least of area times count on both sides.
fn best_border(items: &[Item], bin_of: impl Fn(&Item) -> usize) -> usize {
    let mut bins = [(Aabb::EMPTY, 0usize); BINS];
    for item in items {
        let bin = &mut bins[bin_of(item)];
        *bin = (bin.0.union(item.bounds), bin.1 + 1);
    }
    let cost = |side: &[(Aabb, usize)]| {
        let (bounds, count) = side.iter().fold((Aabb::EMPTY, 0), |(b, n), bin| (b.union(bin.0), n + bin.1));
        bounds.half_area() * count as f64
    };
    let total = |border: usize| cost(&bins[..border]) + cost(&bins[border..]);
    let filled =
        |border: &usize| bins[..*border].iter().any(|bin| bin.1 > 0) && bins[*border..].iter().any(|bin| bin.1 > 0);
    (1..BINS).filter(filled).min_by(|&a, &b| total(a).total_cmp(&total(b))).unwrap_or(1)
}
