//! Which vertices of other strands run alongside a vertex in the picture.

use glam::DVec2;
use rayon::prelude::*;

use crate::FieldError;
use crate::error::{check_number, check_offsets};

/// When two vertices count as neighbours.
#[derive(Clone, Copy, Debug)]
pub struct NeighbourOptions {
    /// Largest distance, in the unit of the points.
    pub radius: f64,
    /// Smallest |cosine| between the two directions.
    pub min_cosine: f64,
    /// Most neighbours of one vertex: the nearest are kept.
    pub most: usize,
}

/// Lists of vertex numbers, one a vertex: `members[starts[i]..starts[i + 1]]`.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Lists {
    /// Where each list begins; one more than there are vertices.
    pub starts: Vec<usize>,
    /// The numbers.
    pub members: Vec<u32>,
}

impl Lists {
    /// The list of `vertex`.
    #[must_use]
    pub fn of(&self, vertex: usize) -> &[u32] {
        &self.members[self.starts[vertex]..self.starts[vertex + 1]]
    }

    fn from_nested(nested: &[Vec<u32>]) -> Self {
        let mut starts = Vec::with_capacity(nested.len() + 1);
        starts.push(0);
        for list in nested {
            starts.push(starts[starts.len() - 1] + list.len());
        }
        Self { starts, members: nested.concat() }
    }

    /// Who names `vertex`: the lists turned round, ascending.
    #[must_use]
    pub fn reversed(&self) -> Self {
        let count = self.starts.len() - 1;
        let mut starts = vec![0; count + 1];
        for &m in &self.members {
            starts[m as usize + 1] += 1;
        }
        for i in 0..count {
            starts[i + 1] += starts[i];
        }
        let mut place = starts.clone();
        let mut members = vec![0; self.members.len()];
        for vertex in 0..count {
            for &m in self.of(vertex) {
                members[place[m as usize]] = vertex as u32;
                place[m as usize] += 1;
            }
        }
        Self { starts, members }
    }
}

/// For every vertex of 2-D strands its nearest neighbours on *other* strands that run in a similar direction and carry the same
/// occlusion flag: N(p) of the portrait paper's E_N.
///
/// # Errors
/// Offsets or flags that do not fit the points; a radius that is not finite.
pub fn neighbours(
    points: &[DVec2],
    offsets: &[i64],
    occluded: &[bool],
    options: NeighbourOptions,
) -> Result<Lists, FieldError> {
    check_offsets(offsets, points.len())?;
    check_number("radius", options.radius)?;
    if occluded.len() != points.len() {
        return Err(FieldError::Length { name: "occluded", found: occluded.len(), expected: points.len() });
    }
    let strand = strand_of_point(offsets, points.len());
    let direction = directions(points, &strand);
    let cells = Cells::new(points, options.radius.max(1e-9));
    let near = |i: usize| {
        let mut found: Vec<(f64, u32)> = Vec::new();
        cells.around(points[i], |j| {
            let distance_sq = points[i].distance_squared(points[j as usize]);
            let alongside = direction[i].dot(direction[j as usize]).abs() >= options.min_cosine;
            let other = strand[i] != strand[j as usize] && occluded[i] == occluded[j as usize];
            if other && alongside && distance_sq <= options.radius * options.radius {
                found.push((distance_sq, j));
            }
        });
        found.sort_by(|a, b| a.0.total_cmp(&b.0).then(a.1.cmp(&b.1)));
        found.truncate(options.most);
        found.into_iter().map(|(_, j)| j).collect()
    };
    let nested: Vec<Vec<u32>> = (0..points.len()).into_par_iter().map(near).collect();
    Ok(Lists::from_nested(&nested))
}

fn strand_of_point(offsets: &[i64], points: usize) -> Vec<u32> {
    let mut strand = vec![0; points];
    for (number, pair) in offsets.windows(2).enumerate() {
        strand[pair[0] as usize..pair[1] as usize].fill(number as u32);
    }
    strand
}

fn directions(points: &[DVec2], strand: &[u32]) -> Vec<DVec2> {
    let same = |i: usize, j: usize| strand.get(j).is_some_and(|s| *s == strand[i]);
    (0..points.len())
        .map(|i| {
            let before = if i > 0 && same(i, i - 1) { i - 1 } else { i };
            let after = if same(i, i + 1) { i + 1 } else { i };
            (points[after] - points[before]).normalize_or_zero()
        })
        .collect()
}

/// Points sorted into square cells.
struct Cells {
    low: DVec2,
    size: f64,
    columns: usize,
    rows: usize,
    starts: Vec<usize>,
    members: Vec<u32>,
}

impl Cells {
    fn new(points: &[DVec2], size: f64) -> Self {
        let low = points.iter().copied().fold(DVec2::INFINITY, DVec2::min);
        let high = points.iter().copied().fold(DVec2::NEG_INFINITY, DVec2::max);
        let extent = if points.is_empty() { DVec2::ZERO } else { high - low };
        let size = size.max(extent.max_element() / 4096.0);
        let (columns, rows) = ((extent.x / size) as usize + 1, (extent.y / size) as usize + 1);
        let mut cells =
            Self { low, size, columns, rows, starts: vec![0; columns * rows + 1], members: vec![0; points.len()] };
        let of: Vec<usize> = points.iter().map(|&p| cells.cell(p)).collect();
        for &cell in &of {
            cells.starts[cell + 1] += 1;
        }
        for i in 0..columns * rows {
            cells.starts[i + 1] += cells.starts[i];
        }
        let mut place = cells.starts.clone();
        for (i, &cell) in of.iter().enumerate() {
            cells.members[place[cell]] = i as u32;
            place[cell] += 1;
        }
        cells
    }

    fn place(&self, p: DVec2) -> [usize; 2] {
        let q = (p - self.low) / self.size;
        [(q.x.max(0.0) as usize).min(self.columns - 1), (q.y.max(0.0) as usize).min(self.rows - 1)]
    }

    fn cell(&self, p: DVec2) -> usize {
        let [x, y] = self.place(p);
        y * self.columns + x
    }

    fn around(&self, p: DVec2, mut visit: impl FnMut(u32)) {
        let [x, y] = self.place(p);
        for row in y.saturating_sub(1)..=(y + 1).min(self.rows - 1) {
            let first = row * self.columns + x.saturating_sub(1);
            let last = row * self.columns + (x + 1).min(self.columns - 1);
            for &member in &self.members[self.starts[first]..self.starts[last + 1]] {
                visit(member);
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn agrees_with_the_search_through_all_pairs() {
        let mut points = Vec::new();
        let mut offsets = vec![0];
        for strand in 0..20 {
            for step in 0..8 {
                let angle = f64::from(strand) * 0.4;
                points.push(
                    DVec2::new(f64::from(strand % 5), f64::from(strand / 5))
                        + DVec2::from_angle(angle) * 0.3 * f64::from(step),
                );
            }
            offsets.push(points.len() as i64);
        }
        let occluded: Vec<bool> = (0..points.len()).map(|i| i % 3 == 0).collect();
        let options = NeighbourOptions { radius: 1.2, min_cosine: 0.8, most: 100 };
        let found = neighbours(&points, &offsets, &occluded, options).expect("fits");
        let strand = strand_of_point(&offsets, points.len());
        let direction = directions(&points, &strand);
        for i in 0..points.len() {
            let mut mine: Vec<u32> = found.of(i).to_vec();
            mine.sort_unstable();
            let all: Vec<u32> = (0..points.len())
                .filter(|&j| strand[i] != strand[j] && occluded[i] == occluded[j])
                .filter(|&j| points[i].distance(points[j]) <= 1.2 && direction[i].dot(direction[j]).abs() >= 0.8)
                .map(|j| j as u32)
                .collect();
            assert_eq!(mine, all);
        }
        let back = found.reversed();
        assert!((0..points.len()).all(|i| found.of(i).iter().all(|&j| back.of(j as usize).contains(&(i as u32)))));
    }
}
