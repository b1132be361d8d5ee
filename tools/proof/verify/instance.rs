// SPDX-License-Identifier: MIT
//! Instances with their maps and roadmaps (docs/formats.md), places and links, and the checksum of it all (docs/proof.md, 1 and 6).
use crate::json::Json;
use std::collections::HashMap;
use std::path::Path;

pub type Place = u32;

#[derive(Default)]
pub struct World {
    pub size: Option<(u32, u32)>,
    pub passable: Vec<bool>,
    pub links: Vec<Vec<Place>>,
    pub neighbours: Vec<Vec<Place>>,
}

#[derive(Default)]
pub struct Agent {
    pub start: Place,
    pub goal: Option<Place>,
    pub turn: u32,
    /// Heading at the start, the one it turns to, steps of that done: 0..4 are N, E, S, W.
    pub looks: (u32, u32, u32),
    pub goal_heading: Option<u32>,
    pub working: Option<(u32, u32)>,
    pub tasks: Vec<u32>,
}

pub struct Task {
    pub place: Place,
    pub duration: u32,
    agents: Vec<u32>,
}

pub struct Instance {
    pub world: World,
    pub agents: Vec<Agent>,
    pub tasks: Vec<Task>,
    pub checksum: u64,
}

struct Road {
    from: u32,
    to: u32,
    steps: u32,
    one_way: bool,
    inner: Place,
}

/// What names of places mean.
struct Names {
    vertices: HashMap<String, Place>,
    roads: Vec<Road>,
}

const HEADINGS: &str = "NESW";
const MOST_PLACES: u64 = 1 << 26;

fn need<T>(value: Option<T>, where_: &str, what: &str) -> Result<T, String> {
    value.ok_or_else(|| format!("{}: expected {}", where_, what))
}

fn read(path: &Path) -> Result<Vec<u8>, String> {
    std::fs::read(path).map_err(|error| format!("{}: {}", path.display(), error))
}

fn heading(value: &Json) -> Option<u32> {
    value.text().filter(|text| text.len() == 1).and_then(|text| HEADINGS.find(text)).map(|found| found as u32)
}

impl World {
    fn link(&mut self, from: Place, to: Place) {
        let add = |list: &mut Vec<Place>, place| {
            if !list.contains(&place) {
                list.push(place);
            }
        };
        add(&mut self.links[from as usize], to);
        add(&mut self.neighbours[from as usize], to);
        add(&mut self.neighbours[to as usize], from);
    }

    fn of(places: usize) -> World {
        World { links: vec![Vec::new(); places], neighbours: vec![Vec::new(); places], ..World::default() }
    }

    /// The cell ahead of one, if it is there and passable.
    pub fn ahead(&self, cell: Place, heading: u32) -> Option<Place> {
        let (width, height) = self.size?;
        let (x, y) = (cell % width, cell / width);
        let next = match heading {
            0 if y > 0 => cell - width,
            1 if x + 1 < width => cell + 1,
            2 if y + 1 < height => cell + width,
            3 if x > 0 => cell - 1,
            _ => return None,
        };
        Some(next).filter(|&place| self.passable[place as usize])
    }

    fn map(text: &[u8], sum: &mut Vec<String>) -> Result<World, String> {
        let text = String::from_utf8_lossy(text);
        let mut lines = text.lines();
        let mut size = [0u32; 2];
        lines.next().filter(|line| line.trim_end() == "type octile").ok_or("line 1: expected 'type octile'")?;
        for (value, name) in size.iter_mut().zip(["height", "width"]) {
            let words: Vec<&str> = lines.next().unwrap_or("").split_whitespace().collect();
            let found = words.get(1).filter(|_| words.len() == 2 && words[0] == name).and_then(|word| word.parse().ok());
            *value = need(found.filter(|&n| n > 0), "its head", name)?;
        }
        lines.next().filter(|line| line.trim_end() == "map").ok_or("line 4: expected 'map'")?;
        let [height, width] = size;
        let places = u64::from(height) * u64::from(width);
        if places > MOST_PLACES {
            return Err("larger than this program takes".to_string());
        }
        sum.push(format!("grid {} {}", width, height));
        let mut world = World { size: Some((width, height)), ..World::of(places as usize) };
        for y in 0..height {
            let row = lines.next().map(|line| line.trim_end_matches('\r')).filter(|line| line.chars().count() == width as usize);
            for letter in need(row, &format!("line {}", y + 5), "a row of the map")?.chars() {
                world.passable.push(match letter {
                    '.' | 'G' | 'S' | 'E' => true,
                    '@' | 'O' | 'T' | 'W' => false,
                    _ => return Err(format!("line {}: expected cells", y + 5)),
                });
            }
            let cells = &world.passable[(y * width) as usize..];
            sum.push(cells.iter().map(|&free| if free { '.' } else { '@' }).collect());
        }
        for cell in (0..height * width).filter(|&cell| world.passable[cell as usize]).collect::<Vec<_>>() {
            for next in (0..4).filter_map(|heading| world.ahead(cell, heading)).collect::<Vec<_>>() {
                world.link(cell, next);
            }
        }
        Ok(world)
    }

    fn roadmap(text: &[u8], sum: &mut Vec<String>) -> Result<(World, Names), String> {
        let json = Json::parse(text)?;
        let list = |key: &str| need(json.get(key).and_then(Json::list), key, "a list");
        let (vertices, edges) = (list("vertices")?, list("edges")?);
        let mut names = Names { vertices: HashMap::new(), roads: Vec::new() };
        for (number, vertex) in vertices.iter().enumerate() {
            let id = need(vertex.get("id").and_then(Json::text), &format!("vertex {}", number), "an id")?;
            if names.vertices.insert(id.to_string(), number as u32).is_some() {
                return Err(format!("vertex {}: expected another id", number));
            }
        }
        sum.push(format!("roadmap {} {}", vertices.len(), edges.len()));
        let mut places = vertices.len() as u64;
        for (number, edge) in edges.iter().enumerate() {
            let at = format!("edge {}", number);
            let end = |key: &str| need(edge.get(key).and_then(Json::text).and_then(|id| names.vertices.get(id)), &at, "two vertices");
            let steps = need(edge.get("steps").and_then(Json::number).filter(|&n| n > 0), &at, "steps")?;
            let one_way = match edge.get("one_way") {
                Some(Json::Bool(value)) => *value,
                value => need(value.map_or(Some(false), |_| None), &at, "one_way true or false")?,
            };
            let road = Road { from: *end("from")?, to: *end("to")?, steps, one_way, inner: places as u32 };
            places += u64::from(steps) - 1;
            if road.from == road.to || places > MOST_PLACES {
                return Err(format!("{}: expected two vertices, and fewer places", at));
            }
            sum.push(format!("{} {} {} {}", road.from, road.to, steps, u32::from(one_way)));
            names.roads.push(road);
        }
        let mut world = World { passable: vec![true; places as usize], ..World::of(places as usize) };
        for road in &names.roads {
            for step in 0..road.steps {
                let (one, two) = (road.place(step), road.place(step + 1));
                world.link(one, two);
                if !road.one_way {
                    world.link(two, one);
                }
            }
        }
        Ok((world, names))
    }
}

impl Road {
    fn place(&self, step: u32) -> Place {
        match step {
            0 => self.from,
            _ if step == self.steps => self.to,
            _ => self.inner + step - 1,
        }
    }
}

impl Names {
    fn vertex(&self, value: &Json) -> Option<Place> {
        self.vertices.get(value.text()?).copied()
    }

    /// A vertex, or a place within a road.
    fn place(&self, value: &Json) -> Option<Place> {
        match value {
            Json::List(parts) if parts.len() == 1 => self.vertex(&parts[0]),
            Json::List(parts) if parts.len() == 3 || parts.len() == 4 => {
                let (from, to, step) = (self.vertex(&parts[0])?, self.vertex(&parts[1])?, parts[2].number()?);
                let roads = match parts.get(3) {
                    Some(number) => self.roads.get(number.number()? as usize..)?.get(..1)?,
                    None => &self.roads[..],
                };
                let find = |from, to| roads.iter().find(|road| (road.from, road.to) == (from, to) && 0 < step && step < road.steps);
                let backwards = || find(to, from).map(|road| road.place(road.steps - step));
                find(from, to).map(|road| road.place(step)).or_else(backwards)
            }
            _ => self.vertex(value),
        }
    }
}

/// Reads what agents and tasks say of places.
struct Reader {
    world: World,
    names: Option<Names>,
}

impl Reader {
    /// The place, and headings if there are any.
    fn place(&self, value: Option<&Json>, at: &str) -> Result<(Place, Option<(u32, u32, u32)>), String> {
        let value = need(value, at, "a place")?;
        if let Some(names) = &self.names {
            return Ok((need(names.place(value), at, "a vertex, or a place on a road")?, None));
        }
        let parts = need(value.list().filter(|parts| matches!(parts.len(), 2 | 3 | 5)), at, "[x, y]")?;
        let (width, height) = need(self.world.size, at, "a map")?;
        let (x, y) = need(parts[0].number().zip(parts[1].number()), at, "[x, y]")?;
        let cell = Some(y).filter(|_| x < width && y < height).map(|y| y * width + x);
        let cell = need(cell.filter(|&cell| self.world.passable[cell as usize]), at, "a passable cell")?;
        let looks = match parts.len() {
            3 => heading(&parts[2]).map(|from| (from, from, 0)),
            5 => heading(&parts[2]).zip(heading(&parts[3])).zip(parts[4].number()).map(|((from, to), k)| (from, to, k)),
            _ => return Ok((cell, None)),
        };
        Ok((cell, Some(need(looks, at, "headings")?)))
    }

    fn agent(&self, json: &Json, at: &str) -> Result<Agent, String> {
        let mut agent = Agent::default();
        let (start, looks) = self.place(json.get("start"), at)?;
        agent.start = start;
        if json.get("goal").is_some() {
            agent.goal = Some(self.place(json.get("goal"), at)?.0);
        }
        if json.get("motion").is_some() {
            let number = |value: Option<&Json>| value.map_or(Some(1), Json::number).filter(|&n| n > 0 && n <= 65536);
            agent.turn = need(number(json.get("turn_steps")), at, "turn_steps")?;
            let first = json.get("heading").and_then(heading).map(|from| (from, from, 0));
            agent.looks = need(looks.or(first), at, "a heading")?;
            agent.goal_heading = json.get("goal_heading").map(|value| need(heading(value), at, "a goal_heading")).transpose()?;
            let (from, to, k) = agent.looks;
            if (k == 0) != (from == to) || (k > 0 && ((from + to) % 2 == 0 || k >= agent.turn)) || self.world.size.is_none() {
                return Err(format!("{}: expected a quarter turn on a map", at));
            }
        } else if looks.is_some() {
            return Err(format!("{}: expected motion", at));
        }
        Ok(agent)
    }
}

impl Instance {
    pub fn read(path: &Path) -> Result<Instance, String> {
        let within = |name: &Path, error: String| format!("{}: {}", name.display(), error);
        let json = Json::parse(&read(path)?).map_err(|error| within(path, error))?;
        let mut sum = Vec::new();
        let key = if json.get("map").is_some() { "map" } else { "roadmap" };
        let name = need(json.get(key).and_then(Json::text), &path.display().to_string(), "a map or a roadmap")?;
        let name = path.parent().unwrap_or_else(|| Path::new("")).join(name);
        let text = read(&name)?;
        let reader = if key == "map" {
            World::map(&text, &mut sum).map(|world| Reader { world, names: None })
        } else {
            World::roadmap(&text, &mut sum).map(|(world, names)| Reader { world, names: Some(names) })
        };
        let reader = reader.map_err(|error| within(&name, error))?;
        Instance::of(&json, reader, sum).map_err(|error| within(path, error))
    }

    fn of(json: &Json, reader: Reader, mut sum: Vec<String>) -> Result<Instance, String> {
        let list = |key: &str| need(json.get(key).and_then(Json::list), key, "a list");
        let ids = |key: &str| {
            let mut ids = HashMap::new();
            for (number, value) in list(key)?.iter().enumerate() {
                let at = format!("{} {}", key, number);
                let id = need(value.get("id").and_then(Json::text), &at, "an id")?;
                need(Some(()).filter(|_| ids.insert(id.to_string(), number as u32).is_none()), &at, "another id")?;
            }
            Ok::<_, String>(ids)
        };
        let (agent_ids, task_ids) = (ids("agents")?, ids("tasks")?);
        let mut agents = Vec::new();
        for (number, value) in list("agents")?.iter().enumerate() {
            agents.push(reader.agent(value, &format!("agents {}", number))?);
        }
        let mut tasks = Vec::new();
        for (number, value) in list("tasks")?.iter().enumerate() {
            let at = format!("tasks {}", number);
            let place = reader.place(value.get("cell"), &at)?.0;
            let duration = value.get("duration").map_or(Some(0), Json::number).filter(|&steps| steps <= 65536);
            let mut task = Task { place, duration: need(duration, &at, "a duration")?, agents: Vec::new() };
            for id in need(value.get("agents").and_then(Json::list), &at, "agents")? {
                let agent = *need(id.text().and_then(|id| agent_ids.get(id)), &at, "ids of agents")?;
                need(Some(()).filter(|_| !task.agents.contains(&agent)), &at, "no agent twice")?;
                task.agents.push(agent);
                agents[agent as usize].tasks.push(number as u32);
            }
            tasks.push(task);
        }
        for (number, value) in list("agents")?.iter().enumerate() {
            if let Some(working) = value.get("working") {
                let task = working.get("task").and_then(Json::text).and_then(|id| task_ids.get(id)).copied();
                let found = task.zip(working.get("done").and_then(Json::number)).filter(|&(task, done)| {
                    let (agent, task_) = (&agents[number], &tasks[task as usize]);
                    agent.tasks.contains(&task) && task_.place == agent.start && done < task_.duration
                });
                agents[number].working = Some(need(found, &format!("agents {}", number), "work on a task where it starts")?);
            }
        }
        for agent in &agents {
            let goal = agent.goal.map_or("-1".to_string(), |goal| goal.to_string());
            sum.push(format!("agent {} {} {}", agent.start, goal, agent.turn));
            let letter = |heading: u32| &HEADINGS[heading as usize..heading as usize + 1];
            if agent.turn > 0 {
                let (from, to, k) = agent.looks;
                sum.push(format!("looks {} {} {} {}", letter(from), letter(to), k, agent.goal_heading.map_or("-", letter)));
            }
            if let Some((task, done)) = agent.working {
                sum.push(format!("working {} {}", task, done));
            }
        }
        for task in &tasks {
            let agents: String = task.agents.iter().map(|agent| format!(" {}", agent)).collect();
            sum.push(format!("task {} {}{}", task.place, task.duration, agents));
        }
        let bytes = sum.iter().flat_map(|line| line.bytes().chain([b'\n']));
        let checksum = bytes.fold(0xcbf29ce484222325u64, |sum, byte| (sum ^ u64::from(byte)).wrapping_mul(0x100000001b3));
        Ok(Instance { world: reader.world, agents, tasks, checksum })
    }
}
