// SPDX-License-Identifier: MIT
//! The keys that objects of instances and roadmaps may have (docs/formats.md). Unknown keys are refused, because an ignored key could
//! change the problem, and the bound would then be that of a different problem.
use crate::json::Json;

/// The keys of one kind of object and, for each key, the keys of the objects in its value (None: no objects are checked).
pub struct Keys(&'static [(&'static str, Option<&'static Keys>)]);

static WORKING: Keys = Keys(&[("task", None), ("done", None)]);
static AGENT: Keys = Keys(&[("id", None), ("start", None), ("goal", None), ("goals", None), ("motion", None), ("turn_steps", None), ("heading", None),
    ("goal_heading", None), ("working", Some(&WORKING))]);
static TASK: Keys = Keys(&[("id", None), ("cell", None), ("agents", None), ("need", None), ("duration", None)]);
static VERTEX: Keys = Keys(&[("id", None), ("at", None)]);
static EDGE: Keys = Keys(&[("from", None), ("to", None), ("steps", None), ("one_way", None)]);

pub static INSTANCE: Keys = Keys(&[("map", None), ("roadmap", None), ("agents", Some(&AGENT)), ("tasks", Some(&TASK))]);
pub static ROADMAP: Keys = Keys(&[("vertices", Some(&VERTEX)), ("edges", Some(&EDGE))]);

/// Whether the key holds a remark for people or other programs, whose content is not checked.
fn is_remark(key: &str) -> bool { key.starts_with('_') || key == "$schema" }

impl Keys {
    /// Refuses a value that has an unknown key anywhere except in remarks.
    pub fn check(&self, json: &Json, at: &str) -> Result<(), String> {
        let members = match json {
            Json::Object(members) => members,
            Json::List(values) => {
                return values.iter().enumerate().try_for_each(|(number, value)| self.check(value, &format!("{} {}", at, number)))
            }
            _ => return Ok(()),
        };
        for (key, value) in members.iter().filter(|(key, _)| !is_remark(key)) {
            let within = |name: &str| if at.is_empty() { name.to_string() } else { format!("{} {}", at, name) };
            let known = self.0.iter().find(|(name, _)| name == key);
            let known = known.ok_or_else(|| format!("{}: unknown key", within(&format!("{:.40?}", key))))?;
            known.1.map_or(Ok(()), |keys| keys.check(value, &within(key)))?;
        }
        Ok(())
    }
}
