//! The room that methods need for an island, made when it is asked for first and kept.

use super::Island;
use crate::solve::method::rows::Equations;
use crate::solve::method::{Pose, Workspace};
use crate::world::PointId;

impl Island {
    /// All constraints, to be met by moving all free points.
    pub fn equations(&self) -> Equations {
        let constraints = (0..self.constraints.len() as u32).collect();
        let points = (0..self.n_free as u32).collect();
        Equations::new(&self.constraints, constraints, points, &self.x, &self.w)
    }

    /// The room for methods that solve the island as a whole.
    pub fn take_workspace(&mut self) -> Box<Workspace> {
        if self.plan.is_one_part()
            && let Some(workspace) = self.part_workspaces.pop()
        {
            return Box::new(workspace);
        }
        self.workspace.take().unwrap_or_else(|| Box::new(Workspace::new(self.equations())))
    }

    /// Keeps the room for what comes next.
    pub fn put_workspace(&mut self, workspace: Box<Workspace>) {
        if self.plan.is_one_part() {
            // What is solved as one part is the island itself.
            self.part_workspaces = vec![*workspace];
        } else {
            self.workspace = Some(workspace);
        }
    }

    /// The room of each part that is solved as a whole, made when it is needed first.
    pub fn take_part_workspaces(&mut self) -> Vec<Workspace> {
        let mut workspaces = std::mem::take(&mut self.part_workspaces);
        if workspaces.is_empty() {
            workspaces.extend(self.plan.rest.iter().map(|part| {
                let (constraints, points) = (part.constraints.clone(), part.points.clone());
                Workspace::new(Equations::new(
                    &self.constraints,
                    constraints,
                    points,
                    &self.x,
                    &self.w,
                ))
            }));
        }
        workspaces
    }

    /// Lets a method improve the pose of the island as a whole; it gets the handles of the free
    /// points too.
    pub fn with_workspace<T>(
        &mut self,
        improve: impl FnOnce(&mut Workspace, &mut Pose, &[PointId]) -> T,
    ) -> T {
        let mut workspace = self.take_workspace();
        let mut pose = Pose { constraints: &self.constraints, x: &mut self.x };
        let result = improve(&mut workspace, &mut pose, &self.points[..self.n_free]);
        self.put_workspace(workspace);
        result
    }

    /// Gives up the room for the island as a whole, which is not needed while it can be
    /// followed part by part.
    pub fn drop_workspace(&mut self) {
        self.workspace = None;
    }
}
