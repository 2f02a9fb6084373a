//! Strands joined into polylines, by the owners of their ends.

use super::crossing::Owner;
use super::traces::Strand;
use crate::mesh::Vector;

/// One end of a strand.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub struct End {
    /// The strand's number.
    pub strand: usize,
    /// Whether it is the strand's last point, not its first.
    pub last: bool,
}

/// A strand as part of a polyline.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Link {
    /// The strand's number.
    pub strand: usize,
    /// Whether the polyline follows it backwards.
    pub backwards: bool,
}

/// Strands in order, end to start.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Chain {
    /// The strands.
    pub links: Vec<Link>,
    /// Whether the last one ends where the first one starts.
    pub closed: bool,
}

/// Strands joined into chains.
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct Stitched {
    /// The chains, in the order of their first strands.
    pub chains: Vec<Chain>,
    /// The joints at the first and last point of each strand: ends with the same
    /// owner have the same joint.
    pub joints: Vec<[u32; 2]>,
    /// How many joints there are.
    pub joint_count: usize,
}

/// Joins strands that end at points of one owner.
///
/// `leaving` gives the direction in which a strand leaves one of its ends. Where
/// two strands meet they are joined. Where more meet, at a mesh point in which
/// contours cross, or at an edge of three triangles, those that run straight on
/// are joined, and what is left over ends there. Each chain follows its first
/// strand's direction, and chains stand in the order of their first strands.
pub fn stitch(strands: &[Strand], leaving: impl Fn(End) -> Vector) -> Stitched {
    let mut partners = vec![[None; 2]; strands.len()];
    let mut joints = vec![[0; 2]; strands.len()];
    let ends = ends_by_owner(strands);
    let mut joint_count = 0;
    for meeting in ends.chunk_by(|a, b| a.0 == b.0) {
        for &(_, end) in meeting {
            joints[end.strand][usize::from(end.last)] = joint_count as u32;
        }
        for [a, b] in joined(meeting, &leaving) {
            partners[a.strand][usize::from(a.last)] = Some(b);
            partners[b.strand][usize::from(b.last)] = Some(a);
        }
        joint_count += 1;
    }
    Stitched { chains: chains(&partners), joints, joint_count }
}

/// The end that continues each end, `[first, last]` of each strand.
type Partners = [[Option<End>; 2]];

fn ends_by_owner(strands: &[Strand]) -> Vec<(Owner, End)> {
    let mut ends: Vec<(Owner, End)> = Vec::with_capacity(2 * strands.len());
    for (number, strand) in strands.iter().enumerate() {
        ends.push((strand.start.owner, End { strand: number, last: false }));
        ends.push((strand.end.owner, End { strand: number, last: true }));
    }
    ends.sort_unstable();
    ends
}

fn chains(partners: &Partners) -> Vec<Chain> {
    let mut used = vec![false; partners.len()];
    let mut chains = Vec::new();
    for strand in 0..partners.len() {
        if !used[strand] {
            let chain = chain_through(strand, partners);
            for link in &chain.links {
                used[link.strand] = true;
            }
            chains.push(chain);
        }
    }
    chains
}

/// Which of the ends that meet at a point continue each other.
fn joined(meeting: &[(Owner, End)], leaving: &impl Fn(End) -> Vector) -> Vec<[End; 2]> {
    match *meeting {
        [_] => Vec::new(),
        [(_, a), (_, b)] => vec![[a, b]],
        _ => straightest(meeting, leaving),
    }
}

/// Of more than two ends, pairs by how little the line bends.
fn straightest(meeting: &[(Owner, End)], leaving: &impl Fn(End) -> Vector) -> Vec<[End; 2]> {
    let mut candidates = Vec::new();
    for (place, &(_, a)) in meeting.iter().enumerate() {
        for &(_, b) in &meeting[place + 1..] {
            candidates.push((leaving(a).dot(&leaving(b)), a, b));
        }
    }
    candidates.sort_by(|x, y| x.0.total_cmp(&y.0));
    let mut pairs: Vec<[End; 2]> = Vec::new();
    for (_, a, b) in candidates {
        if !pairs.iter().flatten().any(|&taken| taken == a || taken == b) {
            pairs.push([a, b]);
        }
    }
    pairs
}

/// The whole chain that holds a strand, in that strand's direction.
fn chain_through(strand: usize, partners: &Partners) -> Chain {
    let first = Link { strand, backwards: false };
    // backwards to the beginning, or once around
    let mut start = first;
    while let Some(previous) = neighbour(start, partners, false) {
        if previous == first {
            return Chain { links: forwards(first, partners), closed: true };
        }
        start = previous;
    }
    Chain { links: forwards(start, partners), closed: false }
}

/// The links from `start` on, to the end or once around.
fn forwards(start: Link, partners: &Partners) -> Vec<Link> {
    let mut links = vec![start];
    let mut link = start;
    while let Some(next) = neighbour(link, partners, true).filter(|&next| next != start) {
        links.push(next);
        link = next;
    }
    links
}

/// The link after (or before) a link.
fn neighbour(link: Link, partners: &Partners, after: bool) -> Option<Link> {
    let at_last = link.backwards != after;
    let end = partners[link.strand][usize::from(at_last)]?;
    // entered at its last point, a strand is followed backwards
    Some(Link { strand: end.strand, backwards: end.last == after })
}

#[cfg(test)]
mod tests {
    use super::super::crossing::Crossing;
    use super::*;

    fn strand(start: u32, end: u32) -> Strand {
        let crossing = |point: u32| Crossing {
            owner: Owner::Point(point),
            at: [1.0, 0.0, 0.0],
            position: Vector::new(f64::from(point), 0.0, 0.0),
        };
        let (start, end) = (crossing(start), crossing(end));
        Strand { start, end, cell: 0, first_point: 0, first_curve: 0 }
    }

    fn chains(strands: &[Strand]) -> Vec<(Vec<(usize, bool)>, bool)> {
        let leaving = |end: End| {
            let Strand { start, end: last, .. } = strands[end.strand];
            let along = last.position - start.position;
            if end.last { -along } else { along }
        };
        stitch(strands, leaving)
            .chains
            .into_iter()
            .map(|chain| {
                let links = chain.links.iter().map(|link| (link.strand, link.backwards));
                (links.collect(), chain.closed)
            })
            .collect()
    }

    #[test]
    fn an_open_line_out_of_order() {
        let strands = [strand(1, 2), strand(2, 3), strand(0, 1)];
        assert_eq!(chains(&strands), [(vec![(2, false), (0, false), (1, false)], false)]);
    }

    #[test]
    fn a_loop() {
        let strands = [strand(0, 1), strand(2, 0), strand(1, 2)];
        assert_eq!(chains(&strands), [(vec![(0, false), (2, false), (1, false)], true)]);
    }

    #[test]
    fn a_loop_of_one_and_of_two() {
        assert_eq!(chains(&[strand(5, 5)]), [(vec![(0, false)], true)]);
        let two = [strand(0, 1), strand(0, 1)];
        assert_eq!(chains(&two), [(vec![(0, false), (1, true)], true)]);
    }

    #[test]
    fn strands_of_mixed_directions() {
        let strands = [strand(1, 0), strand(1, 2)];
        assert_eq!(chains(&strands), [(vec![(1, true), (0, false)], false)]);
    }

    #[test]
    fn two_lines_that_cross_run_straight_on() {
        // points 0, 2 and 4 in a row, all on the x axis: 2 is the crossing
        let strands = [strand(0, 2), strand(4, 2), strand(2, 6), strand(2, 1)];
        let found = chains(&strands);
        assert_eq!(found.len(), 2);
        assert!(found.iter().all(|(links, closed)| links.len() == 2 && !closed));
    }

    #[test]
    fn of_three_one_ends() {
        let strands = [strand(0, 2), strand(2, 4), strand(2, 5)];
        assert_eq!(chains(&strands).len(), 2);
    }
}
