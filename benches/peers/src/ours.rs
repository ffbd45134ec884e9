//! linkwork as its user runs it: statements given to a session, default settings, no output.

use cpu_time::ProcessTime;
use linkwork::lang::ast::Statement;
use linkwork::session::{Nowhere, Session};
use linkwork::world::{Entity, PointId};

use crate::peer::{Peer, Run};
use crate::work::{Place, Work};

pub struct Ours<'a> {
    work: &'a Work,
    session: Session,
    ids: Vec<PointId>,
}

fn statements(session: &mut Session, text: &str) -> Result<Vec<Statement>, String> {
    let source = session.add_source("work", text, None);
    linkwork::lang::parse(source, text)
        .map(|statement| statement.map_err(|e| e.message.to_string()))
        .collect()
}

fn execute(session: &mut Session, text: &str) -> Result<(), String> {
    for statement in statements(session, text)? {
        session.execute(&statement, &mut Nowhere).map_err(|e| e.message.to_string())?;
    }
    Ok(())
}

impl<'a> Ours<'a> {
    /// The script up to its last statement, which is the one that runs.
    pub fn start(work: &'a Work) -> Result<Self, String> {
        let mut session = Session::new();
        for &(name, value) in &work.set {
            session.override_parameter(name, value);
        }
        let all = statements(&mut session, work.script)?;
        let (_, setup) = all.split_last().ok_or("an empty script")?;
        for statement in setup {
            session.execute(statement, &mut Nowhere).map_err(|e| e.message.to_string())?;
        }
        if let Some(degrees) = work.degrees {
            execute(&mut session, &format!("set dt {degrees}/360"))?;
        }
        let ids = work.names.iter().map(|name| match session.world().names().get(name) {
            Some(Entity::Point(id)) => Ok(id),
            _ => Err(format!("no point `{name}` in the script of {}", work.name)),
        });
        let ids = ids.collect::<Result<Vec<_>, _>>()?;
        let mut ours = Self { work, session, ids };
        ours.compare()?;
        Ok(ours)
    }

    /// Whether the script makes the points that the other peers are given. Only what is held is
    /// compared: a script gives the others rough positions, the peers a solved pose.
    fn compare(&mut self) -> Result<(), String> {
        let n = self.session.world().points().len();
        let pose = self.pose();
        let held = self.work.ground.iter().chain(self.work.driven.iter().map(|d| &d.0));
        let far = held.copied().any(|p| {
            let (a, b) = (pose[p], self.work.start[p]);
            (a[0] - b[0]).hypot(a[1] - b[1]) > 1e-9 * self.work.size()
        });
        if n != self.work.start.len() || far {
            return Err(format!("the script of {} makes other points", self.work.name));
        }
        Ok(())
    }
}

impl Peer for Ours<'_> {
    fn run(&mut self, from: usize, n: usize) -> Result<Run, String> {
        let text = if self.work.degrees.is_some() {
            format!("step {n}")
        } else {
            let (p, about) = self.work.driven[0];
            let [x, y] = self.work.target(about, from + n);
            format!("drag {} to ({x:?}, {y:?}) over {n}", self.work.names[p])
        };
        let begun = ProcessTime::now();
        execute(&mut self.session, &text)?;
        let seconds = begun.elapsed().as_secs_f64();
        let n_failed = self.session.last_run().map_or(n, |run| run.n_missed as usize);
        Ok(Run { seconds, n_failed })
    }

    fn needs_whole_blocks(&self) -> bool {
        true
    }

    fn pose(&mut self) -> Vec<Place> {
        let points = self.session.world().points();
        self.ids.iter().map(|&id| points.at(id)).map(|p| [p.x, p.y]).collect()
    }
}
