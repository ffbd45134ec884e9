//! rapier2d with its default parameters and no gravity: each bar a body, each joint a revolute
//! joint, held and driven points kinematic bodies. One step a frame.

use rapier2d::prelude::*;

use crate::peer::Peer;
use crate::work::{Place, Relation, Work};

pub struct Engine<'a> {
    work: &'a Work,
    world: PhysicsWorld,
    /// The body that shows where a point is, and where on the body.
    seen: Vec<(RigidBodyHandle, Vector)>,
    driven: Vec<RigidBodyHandle>,
}

fn vector(p: Place) -> Vector {
    Vector::new(p[0] as Real, p[1] as Real)
}

impl<'a> Engine<'a> {
    /// None where the work has another relation than lengths.
    pub fn start(work: &'a Work) -> Option<Self> {
        let mut world = PhysicsWorld { gravity: Vector::ZERO, ..PhysicsWorld::default() };
        let mut seen: Vec<Option<(RigidBodyHandle, Vector)>> = vec![None; work.start.len()];
        for &p in &work.ground {
            let body = RigidBodyBuilder::fixed().translation(vector(work.start[p]));
            seen[p] = Some((world.bodies.insert(body), Vector::ZERO));
        }
        let mut driven = Vec::new();
        for &(p, _) in &work.driven {
            let body =
                RigidBodyBuilder::kinematic_position_based().translation(vector(work.start[p]));
            driven.push(world.bodies.insert(body));
            seen[p] = Some((driven[driven.len() - 1], Vector::ZERO));
        }
        for relation in &work.relations {
            let Relation::Length(a, b, l) = *relation else { return None };
            let [pa, pb] = [work.start[a], work.start[b]];
            let middle = [f64::midpoint(pa[0], pb[0]), f64::midpoint(pa[1], pb[1])];
            let angle = (pb[1] - pa[1]).atan2(pb[0] - pa[0]);
            // A uniform bar of mass 1 per length; never asleep, as it is driven in every frame.
            let bar = RigidBodyBuilder::dynamic()
                .translation(vector(middle))
                .rotation(angle as Real)
                .can_sleep(false)
                .additional_mass_properties(MassProperties::new(
                    Vector::ZERO,
                    l as Real,
                    (l * l * l / 12.0) as Real,
                ));
            let bar = world.bodies.insert(bar);
            for (p, end) in [(a, -0.5 * l), (b, 0.5 * l)] {
                let anchor = Vector::new(end as Real, 0.0);
                match seen[p] {
                    None => seen[p] = Some((bar, anchor)),
                    Some((other, place)) => {
                        let joint = RevoluteJointBuilder::new()
                            .contacts_enabled(false)
                            .local_anchor1(place)
                            .local_anchor2(anchor);
                        world.impulse_joints.insert(other, bar, joint, true);
                    }
                }
            }
        }
        // Points that no bar holds are not seen to move.
        let seen = (seen.into_iter().zip(&work.start))
            .map(|(seen, &at)| {
                seen.unwrap_or_else(|| {
                    let body = RigidBodyBuilder::fixed().translation(vector(at));
                    (world.bodies.insert(body), Vector::ZERO)
                })
            })
            .collect();
        Some(Self { work, world, seen, driven })
    }
}

impl Peer for Engine<'_> {
    fn frame(&mut self, k: usize) -> bool {
        for (&(_, about), &body) in self.work.driven.iter().zip(&self.driven) {
            let at = self.work.target(about, k);
            self.world.bodies[body].set_next_kinematic_translation(vector(at));
        }
        self.world.step();
        true
    }

    fn pose(&mut self) -> Vec<Place> {
        self.seen
            .iter()
            .map(|&(body, at)| {
                let p = self.world.bodies[body].position().transform_point(at);
                [f64::from(p.x), f64::from(p.y)]
            })
            .collect()
    }
}
