// SPDX-License-Identifier: MIT
//! Reads instances with their maps and roadmaps (docs/formats.md). Derives places and links (docs/proof.md, section 1) and the checksum
//! (section 6).
use crate::json::Json;
use crate::keys;
use std::collections::{HashMap, HashSet};
use std::path::{Path, PathBuf};

pub type Place = u32;

#[derive(Default)]
pub struct World {
    size: (u32, u32),
    pub passable: Vec<bool>,
    pub links: Vec<Vec<Place>>,
    pub neighbours: Vec<Vec<Place>>,
}

#[derive(Default)]
pub struct Agent {
    pub start: Place,
    pub goal: Option<Place>,
    /// The places of which it chooses its destination; empty: it has no such choice.
    pub goals: Vec<Place>,
    pub turn: u32,
    /// Heading at the start, heading to which the agent is turning, and completed steps of this turn. Headings are 0 to 3: N, E, S, W.
    pub looks: (u32, u32, u32),
    pub goal_heading: Option<u32>,
    /// The task that the agent executes at the start, and the completed steps of this execution.
    pub working: Option<(u32, u32)>,
    /// The tasks that it must visit.
    pub tasks: Vec<u32>,
    /// The tasks that it may visit.
    pub options: Vec<u32>,
}

impl Agent {
    pub fn has_choice(&self) -> bool { !self.goals.is_empty() || !self.options.is_empty() }
}

pub struct Task {
    pub place: Place,
    pub duration: u32,
    /// The number of its agents that must visit it.
    pub need: u32,
    pub agents: Vec<u32>,
}


pub struct Instance {
    pub world: World,
    pub agents: Vec<Agent>,
    pub tasks: Vec<Task>,
    pub checksum: u64,
}

struct Road {
    from: Place,
    to: Place,
    steps: u32,
    inner: Place,
}

const HEADINGS: &str = "NESW";
const MAX_PLACES: u64 = 1 << 26;
const MAX_TASKS: usize = 64;

fn require<T>(value: Option<T>, at: &str, what: &str) -> Result<T, String> {
    value.ok_or_else(|| format!("{}: expected {}", at, what))
}

fn heading(value: &Json) -> Option<u32> {
    value.text().filter(|text| text.len() == 1).and_then(|text| HEADINGS.find(text)).map(|found| found as u32)
}

/// Parses the agents of a task: a list of ids, or "*" for all of the `count` agents.
fn task_agents(ids: &HashMap<String, u32>, count: u32, value: Option<&Json>, at: &str) -> Result<Vec<u32>, String> {
    if value.and_then(Json::text) == Some("*") { return Ok((0..count).collect()); }
    let list = require(value.and_then(Json::list).filter(|ids| !ids.is_empty()), at, "agents, a list of ids")?;
    list.iter().map(|id| require(id.text().and_then(|id| ids.get(id)).copied(), at, "ids of agents")).collect()
}

/// Parses a number that consists of digits only.
fn whole(word: &str) -> Option<u32> { word.parse().ok().filter(|_| word.bytes().all(|byte| byte.is_ascii_digit())) }

impl World {
    fn of(places: u64, size: (u32, u32)) -> World {
        let lists = vec![Vec::new(); places as usize];
        World { size, links: lists.clone(), neighbours: lists, passable: Vec::new() }
    }

    fn link(&mut self, from: Place, to: Place) {
        let add = |list: &mut Vec<Place>, place| if !list.contains(&place) { list.push(place) };
        add(&mut self.links[from as usize], to);
        add(&mut self.neighbours[from as usize], to);
        add(&mut self.neighbours[to as usize], from);
    }

    /// Returns the next cell in the direction `heading`. Returns None at the edge of the map, and if that cell is blocked.
    pub fn ahead(&self, cell: Place, heading: u32) -> Option<Place> {
        let (width, height) = self.size;
        let next = match heading {
            0 if cell / width > 0 => cell - width,
            1 if cell % width + 1 < width => cell + 1,
            2 if cell / width + 1 < height => cell + width,
            3 if cell % width > 0 => cell - 1,
            _ => return None,
        };
        Some(next).filter(|&place| self.passable[place as usize])
    }

    fn map(text: &str, sum: &mut String) -> Result<World, String> {
        let mut lines = text.lines();
        let mut head = || lines.next().map(|line| line.trim_end_matches(|blank| blank == ' ' || blank == '\t')).unwrap_or("");
        let octile = head() == "type octile";
        let sides = [head(), head()];
        let side = |name: &str| sides.iter().find_map(|line| line.strip_prefix(name)).and_then(whole).filter(|&n| n > 0);
        let (height, width) = require(side("height ").zip(side("width ")).filter(|_| octile), "its head", "type octile, height, width")?;
        require(Some(()).filter(|_| head() == "map"), "line 4", "map")?;
        let places = require(u64::from(height).checked_mul(u64::from(width)).filter(|&n| n <= MAX_PLACES), "its head", "fewer cells")?;
        let mut world = World::of(places, (width, height));
        *sum += &format!("grid {} {}\n", width, height);
        for y in 0..height {
            let at = format!("line {}", y + 5);
            for letter in require(lines.next().filter(|line| line.len() == width as usize), &at, "a row of the map")?.chars() {
                let free = require(".GSE@OTW".find(letter), &at, "cells")? < 4;
                world.passable.push(free);
                sum.push(if free { '.' } else { '@' });
            }
            sum.push('\n');
        }
        require(Some(()).filter(|_| lines.all(str::is_empty)), "its end", "no more rows")?;
        for cell in (0..places as u32).filter(|&cell| world.passable[cell as usize]).collect::<Vec<_>>() {
            for next in (0..4).filter_map(|heading| world.ahead(cell, heading)).collect::<Vec<_>>() { world.link(cell, next); }
        }
        Ok(world)
    }
}

impl Road {
    fn place(&self, step: u32) -> Place {
        match step { 0 => self.from, _ if step == self.steps => self.to, _ => self.inner + step - 1 }
    }
}

/// Returns, for each id, the index of its object in the list `key`. Refuses missing, empty and repeated ids.
fn ids(json: &Json, key: &str) -> Result<HashMap<String, u32>, String> {
    let mut ids = HashMap::new();
    for (number, value) in require(json.get(key).and_then(Json::list), key, "a list")?.iter().enumerate() {
        let id = value.get("id").and_then(Json::text).filter(|&id| !id.is_empty() && ids.insert(id.to_string(), number as u32).is_none());
        require(id, &format!("{} {}", key, number), "an id that no other has")?;
    }
    Ok(ids)
}

/// Named places of a roadmap. Places of a map have no names.
#[derive(Default)]
struct Names {
    vertices: HashMap<String, Place>,
    roads: Vec<Road>,
}

impl Names {
    fn roadmap(json: &Json, sum: &mut String) -> Result<(World, Names), String> {
        keys::ROADMAP.check(json, "")?;
        let mut names = Names { vertices: ids(json, "vertices")?, roads: Vec::new() };
        for (number, vertex) in json.get("vertices").and_then(Json::list).into_iter().flatten().enumerate() {
            let at = vertex.get("at").and_then(Json::list).filter(|at| at.len() == 2 && at.iter().all(Json::is_number));
            require(at, &format!("vertices {}", number), "at, [x, y] in metres")?;
        }
        require(Some(()).filter(|_| !names.vertices.is_empty()), "vertices", "one at least")?;
        let (mut places, mut both_ways) = (names.vertices.len() as u64, Vec::new());
        let edges = require(json.get("edges").and_then(Json::list), "edges", "a list")?;
        *sum += &format!("roadmap {} {}\n", places, edges.len());
        for (number, edge) in edges.iter().enumerate() {
            let at = format!("edges {}", number);
            let end = |key| edge.get(key).and_then(Json::text).and_then(|id| names.vertices.get(id)).copied();
            let (from, to) = require(end("from").zip(end("to")).filter(|(from, to)| from != to), &at, "two vertices")?;
            let steps = require(edge.get("steps").and_then(Json::number).filter(|&n| n > 0), &at, "steps")?;
            let one_way = match edge.get("one_way") { None => Some(false), Some(Json::Bool(value)) => Some(*value), _ => None };
            both_ways.push(!require(one_way, &at, "one_way true or false")?);
            names.roads.push(Road { from, to, steps, inner: places as u32 });
            places = require(Some(places + u64::from(steps) - 1).filter(|&n| n <= MAX_PLACES), &at, "fewer places")?;
            *sum += &format!("{} {} {} {}\n", from, to, steps, u32::from(!both_ways[number]));
        }
        let mut world = World::of(places, (0, 0));
        world.passable.resize(places as usize, true);
        for (road, both) in names.roads.iter().zip(both_ways) {
            for (one, two) in (0..road.steps).map(|step| (road.place(step), road.place(step + 1))) {
                world.link(one, two);
                if both { world.link(two, one); }
            }
        }
        Ok((world, names))
    }

    /// Parses a vertex: "A" or ["A"].
    fn vertex(&self, value: &Json) -> Option<Place> {
        let id = value.list().filter(|parts| parts.len() == 1).map_or(value, |parts| &parts[0]);
        self.vertices.get(id.text()?).copied()
    }

    /// Parses a vertex, or a place within a road: ["A", "B", steps]. A fourth element, the index of the road, is required if several
    /// roads join A and B.
    fn place(&self, value: &Json) -> Option<Place> {
        let (parts, number) = match value.list() {
            Some(parts @ [_, _, _]) => (parts, None),
            Some([parts @ .., number]) if parts.len() == 3 => (parts, Some(number.number()? as usize)),
            _ => return self.vertex(value),
        };
        let end = |part: &Json| self.vertices.get(part.text()?).copied();
        let (from, to, step) = (end(&parts[0])?, end(&parts[1])?, parts[2].number()?);
        let joins = |road: &&Road| [(from, to), (to, from)].contains(&(road.from, road.to));
        let mut found = self.roads.iter().enumerate().filter(|(other, _)| number.map_or(true, |number| number == *other)).map(|(_, road)| road).filter(joins);
        let road = found.next().filter(|road| found.next().is_none() && 0 < step && step < road.steps)?;
        Some(road.place(if road.from == from { step } else { road.steps - step }))
    }

    /// Parses the place of a task or a goal: a cell or a vertex.
    fn end(&self, world: &World, value: Option<&Json>, at: &str) -> Result<Place, String> {
        if world.size.0 == 0 { return require(value.and_then(|value| self.vertex(value)), at, "a vertex"); }
        let (place, looks) = self.find(world, value, at)?;
        require(Some(place).filter(|_| looks.is_none()), at, "a cell without a heading")
    }

    /// Parses a place, and the headings (see Agent::looks) if the value has any.
    fn find(&self, world: &World, value: Option<&Json>, at: &str) -> Result<(Place, Option<(u32, u32, u32)>), String> {
        let (width, height) = world.size;
        if width == 0 { return Ok((require(value.and_then(|value| self.place(value)), at, "a vertex, or a place on a road")?, None)); }
        let parts = require(value.and_then(Json::list).filter(|parts| matches!(parts.len(), 2 | 3 | 5)), at, "a cell")?;
        let cell = parts[0].number().zip(parts[1].number()).filter(|&(x, y)| x < width && y < height).map(|(x, y)| y * width + x);
        let cell = require(cell.filter(|&cell| world.passable[cell as usize]), at, "a passable cell")?;
        let looks = match parts.len() {
            3 => heading(&parts[2]).map(|from| (from, from, 0)),
            5 => heading(&parts[2]).zip(heading(&parts[3])).zip(parts[4].number().filter(|&k| k > 0)).map(|((from, to), k)| (from, to, k)),
            _ => return Ok((cell, None)),
        };
        Ok((cell, Some(require(looks, at, "headings")?)))
    }

    fn agent(&self, world: &World, json: &Json, at: &str) -> Result<Agent, String> {
        let (start, looks) = self.find(world, json.get("start"), at)?;
        let mut agent = Agent { start, ..Agent::default() };
        if json.get("goal").is_some() { agent.goal = Some(self.end(world, json.get("goal"), at)?); }
        if let Some(value) = json.get("goals") {
            for goal in require(value.list().filter(|goals| !goals.is_empty() && agent.goal.is_none()), at, "goals, a list of places, without goal")? {
                let goal = self.end(world, Some(goal), at)?;
                require(Some(()).filter(|_| !agent.goals.contains(&goal)), at, "no place twice in goals")?;
                agent.goals.push(goal);
            }
        }
        if json.get("motion").is_none() {
            let turns = looks.is_some() || ["turn_steps", "heading", "goal_heading"].iter().any(|key| json.get(key).is_some());
            return require(Some(agent).filter(|_| !turns), at, "motion");
        }
        require(json.get("motion").and_then(Json::text).filter(|&motion| motion == "turning"), at, "motion turning")?;
        let turn = json.get("turn_steps").map_or(Some(1), Json::number).filter(|&n| (1..=65536).contains(&n) && world.size.0 > 0);
        agent.turn = require(turn, at, "turn_steps, on a map")?;
        let said = json.get("heading").map(|value| require(heading(value), at, "a heading")).transpose()?;
        let looks = looks.or_else(|| said.map(|from| (from, from, 0))).filter(|looks| said.map_or(true, |from| from == looks.0));
        let good = |&(from, to, k): &(u32, u32, u32)| if k == 0 { from == to } else { (from + to) % 2 == 1 && k < agent.turn };
        agent.looks = require(looks.filter(good), at, "a heading")?;
        agent.goal_heading = json.get("goal_heading").map(|value| require(heading(value), at, "a goal_heading")).transpose()?;
        require(Some(()).filter(|_| agent.goal_heading.is_none() || agent.goal.is_some() || !agent.goals.is_empty()), at, "a goal with its heading")?;
        Ok(agent)
    }
}

/// Converts the first `count` rows of a scenario to an instance. All rows must name one map.
fn scenario(text: &str, count: u32) -> Result<Json, String> {
    let (mut lines, mut agents, mut same) = (text.lines().zip(1..), Vec::new(), None);
    let mut row = |what: &str| -> Result<(Vec<&str>, String), String> {
        let (line, number) = require(lines.next(), "its end", what)?;
        Ok((line.split_whitespace().collect(), format!("line {}", number)))
    };
    let (version, at) = row("version 1")?;
    require(Some(()).filter(|_| matches!(version[..], ["version", "1" | "1.0"])), &at, "version 1")?;
    let object = |members: Vec<(&str, Json)>| Json::Object(members.into_iter().map(|(key, value)| (key.to_string(), value)).collect());
    let cell = |x: u32, y: u32| Json::List(vec![Json::Whole(x.into()), Json::Whole(y.into())]);
    for number in 0..count {
        let (words, at) = row("a row for each agent")?;
        let numbers: Option<Vec<u32>> = words.iter().skip(2).take(6).map(|word| whole(word)).collect();
        let good = |found: &Vec<u32>| found.len() == 6 && words.len() == 9 && words[8].parse().map_or(false, |length: f64| length >= 0.0);
        let numbers = require(numbers.filter(good), &at, "bucket, map, size, start, goal and length")?;
        let map = (words[1].rsplit('/').next().unwrap_or(""), numbers[0], numbers[1]);
        require(Some(()).filter(|_| *same.get_or_insert(map) == map), &at, "the map of the rows before")?;
        let (start, goal) = (cell(numbers[2], numbers[3]), cell(numbers[4], numbers[5]));
        agents.push(object(vec![("id", Json::Text(number.to_string())), ("start", start), ("goal", goal)]));
    }
    let (name, width, height) = require(same, "its end", "rows")?;
    let map = vec![("map", Json::Text(name.to_string())), ("width", Json::Whole(width.into())), ("height", Json::Whole(height.into()))];
    Ok(object(map.into_iter().chain([("agents", Json::List(agents)), ("tasks", Json::List(Vec::new()))]).collect()))
}

/// Returns the path of the file `name` with all symbolic links resolved. Refuses an absolute `name`, and a file that is not in the folder
/// of `path` or below.
fn confined(path: &Path, name: &str) -> Result<PathBuf, String> {
    let folder = path.parent().filter(|folder| !folder.as_os_str().is_empty()).unwrap_or(Path::new("."));
    let inside = |folder: PathBuf| folder.join(name).canonicalize().ok().filter(|real| !Path::new(name).is_absolute() && real.starts_with(&folder) && real.is_file());
    require(folder.canonicalize().ok().and_then(inside), "its map or roadmap", "a file in the folder of the instance or below, with --confine")
}

impl Instance {
    /// Reads an instance. If `agents` is given, the file is a scenario, and its first `agents` rows are the agents. `map` replaces the map
    /// that the file names. `confine`: refuse a map or roadmap outside the folder of the instance.
    pub fn read(path: &Path, agents: Option<u32>, map: Option<&Path>, confine: bool) -> Result<Instance, String> {
        let read = |path: &Path| {
            let bytes = std::fs::read(path).map_err(|error| format!("{}: {}", path.display(), error))?;
            Ok::<_, String>(bytes.strip_prefix(b"\xef\xbb\xbf").map(<[u8]>::to_vec).unwrap_or(bytes)) // a byte order mark
        };
        let within = |path: &Path, error: String| format!("{}: {}", path.display(), error);
        let text = read(path)?;
        let json = match agents {
            Some(count) => scenario(&String::from_utf8_lossy(&text), count),
            None => Json::parse(&text).and_then(|json| keys::INSTANCE.check(&json, "").map(|_| json)),
        };
        let json = json.map_err(|error| within(path, error))?;
        let one = json.get("map").is_some() != json.get("roadmap").is_some();
        require(Some(()).filter(|_| one), &path.display().to_string(), "a map or a roadmap, and not both")?;
        let (named, roads) = (json.get("map").and_then(Json::text), json.get("roadmap").and_then(Json::text));
        let name = require(named.or(roads), &path.display().to_string(), "a map or a roadmap")?;
        let name = match map {
            Some(map) => map.to_path_buf(),
            None if confine => confined(path, name).map_err(|error| within(path, error))?,
            None => path.with_file_name(name),
        };
        let (text, mut sum) = (read(&name)?, String::new());
        let found = match named {
            Some(_) => World::map(&String::from_utf8_lossy(&text), &mut sum).map(|world| (world, Names::default())),
            None => Json::parse(&text).and_then(|json| Names::roadmap(&json, &mut sum)),
        };
        let (world, names) = found.map_err(|error| within(&name, error))?;
        if agents.is_some() {
            let size = |key| json.get(key).and_then(Json::number).unwrap_or(0);
            let same = (size("width"), size("height")) == world.size && name.file_name().map_or(false, |file| named == file.to_str());
            require(Some(()).filter(|_| same), &within(path, "line 2".to_string()), "the name and size of the map")?;
        }
        Instance::of(&json, world, names, sum).map_err(|error| within(path, error))
    }

    fn of(json: &Json, world: World, names: Names, mut sum: String) -> Result<Instance, String> {
        let (agent_ids, task_ids) = (ids(json, "agents")?, ids(json, "tasks")?);
        let list = |key: &str| json.get(key).and_then(Json::list).into_iter().flatten().enumerate();
        let (mut agents, mut tasks, mut ends) = (Vec::new(), Vec::new(), String::new());
        for (number, value) in list("agents") { agents.push(names.agent(&world, value, &format!("agents {}", number))?); }
        require(Some(()).filter(|_| !agents.is_empty()), "agents", "one at least")?;
        let (mut starts, mut goals) = (HashSet::new(), HashSet::new());
        for (number, agent) in agents.iter().enumerate() {
            let apart = starts.insert(agent.start) && agent.goal.map_or(true, |goal| goals.insert(goal));
            require(Some(()).filter(|_| apart), &format!("agents {}", number), "a start and a goal that no other agent has")?;
        }
        for (number, value) in list("tasks") {
            let at = format!("tasks {}", number);
            let place = names.end(&world, value.get("cell"), &at)?;
            let duration = require(value.get("duration").map_or(Some(0), Json::number).filter(|&steps| steps <= 65536), &at, "a duration")?;
            ends += &format!("task {} {}", place, duration);
            let of = task_agents(&agent_ids, agents.len() as u32, value.get("agents"), &at)?;
            let all = of.len() as u32;
            let need = require(value.get("need").map_or(Some(all), Json::number).filter(|need| (1..=all).contains(need)), &at, "need, at most the number of agents")?;
            for &agent in &of {
                let own: &mut Agent = &mut agents[agent as usize];
                let own = if need < all { &mut own.options } else { &mut own.tasks };
                require(Some(()).filter(|_| own.last() != Some(&(number as u32))), &at, "no agent twice")?;
                require(Some(()).filter(|_| need < all || own.len() < MAX_TASKS), &at, "64 tasks of an agent at most")?;
                own.push(number as u32);
                ends += &format!(" {}", agent);
            }
            ends.push('\n');
            if need < all { ends += &format!("need {}\n", need); }
            tasks.push(Task { place, duration, need, agents: of });
        }
        for (number, value) in list("agents") {
            let agent = &mut agents[number];
            sum += &format!("agent {} {} {}\n", agent.start, agent.goal.map_or("-1".to_string(), |goal| goal.to_string()), agent.turn);
            let letter = |heading: u32| &HEADINGS[heading as usize..heading as usize + 1];
            let ((from, to, k), end) = (agent.looks, agent.goal_heading.map_or("-", letter));
            if agent.turn > 0 { sum += &format!("looks {} {} {} {}\n", letter(from), letter(to), k, end); }
            if !agent.goals.is_empty() {
                let goals: String = agent.goals.iter().map(|goal| format!(" {}", goal)).collect();
                sum += &format!("goals{}\n", goals);
            }
            if let Some(working) = value.get("working") {
                let task = working.get("task").and_then(Json::text).and_then(|id| task_ids.get(id)).copied();
                let good = |task: u32, at: &Task, done| (agent.tasks.contains(&task) || agent.options.contains(&task)) && at.place == agent.start && done < at.duration;
                let found = task.zip(working.get("done").and_then(Json::number)).filter(|&(t, done)| good(t, &tasks[t as usize], done));
                let (task, done) = require(found, &format!("agents {}", number), "work on a task where it starts")?;
                agent.working = Some((task, done));
                sum += &format!("working {} {}\n", task, done);
            }
        }
        let add = |sum: u64, byte: u8| (sum ^ u64::from(byte)).wrapping_mul(0x100000001b3);
        let checksum = sum.bytes().chain(ends.bytes()).fold(0xcbf29ce484222325, add);
        Ok(Instance { world, agents, tasks, checksum })
    }
}
