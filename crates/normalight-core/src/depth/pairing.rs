//! Coarser graphs by pairwise aggregation: Notay, "An aggregation-based algebraic multigrid method",
//! ETNA 37 (2010). Only strong links join nodes, so that what a step in depth parts stays apart.
use super::graph::Graph;

/// A link is strong from this share of its node's strongest.
const STRONG: f32 = 0.25;

/// The parent of a node that has no links and so needs none.
pub(super) const NONE: u32 = u32::MAX;

/// A weighted graph.
pub(super) trait Links {
    /// Number of nodes.
    fn count(&self) -> usize;

    /// Hands out every neighbour of a node and the weight of the link, above zero.
    fn each(&self, node: usize, take: impl FnMut(usize, f32));
}

/// Groups of up to four nodes as the nodes of a coarser graph: its links, and the parent of each node.
pub(super) fn coarsened(fine: &impl Links) -> (Graph, Vec<u32>) {
    let (pairs, mut parents) = paired(fine);
    let (groups, grandparents) = paired(&pairs);
    for parent in &mut parents {
        if *parent != NONE {
            *parent = grandparents[*parent as usize];
        }
    }
    (groups, parents)
}

/// Each node with the neighbour to which its strongest link leads among those that are still alone.
fn paired(fine: &impl Links) -> (Graph, Vec<u32>) {
    let mut parents = vec![NONE; fine.count()];
    let mut members: Vec<[u32; 2]> = Vec::with_capacity(fine.count() / 2);
    for node in 0..fine.count() {
        if parents[node] != NONE {
            continue;
        }
        let (mut strongest, mut best, mut partner) = (0.0, 0.0, NONE);
        fine.each(node, |other, weight| {
            strongest = f32::max(strongest, weight);
            if weight > best && parents[other] == NONE {
                (best, partner) = (weight, other as u32);
            }
        });
        if strongest == 0.0 {
            continue;
        }
        let parent = members.len() as u32;
        parents[node] = parent;
        if best >= STRONG * strongest {
            parents[partner as usize] = parent;
        } else {
            partner = NONE;
        }
        members.push([node as u32, partner]);
    }
    let mut graph = Graph::with_capacity(members.len());
    let mut links: Vec<(u32, f32)> = Vec::new();
    for (node, pair) in members.iter().enumerate() {
        links.clear();
        for &member in pair.iter().filter(|&&member| member != NONE) {
            fine.each(member as usize, |other, weight| {
                let parent = parents[other];
                if parent == node as u32 {
                    return;
                }
                match links.iter_mut().find(|(known, _)| *known == parent) {
                    Some((_, sum)) => *sum += weight,
                    None => links.push((parent, weight)),
                }
            });
        }
        graph.push(&links);
    }
    (graph, parents)
}
