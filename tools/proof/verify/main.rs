// SPDX-License-Identifier: MIT
//! grove-verify: verifies that a certificate proves its bound. Implements docs/proof.md and shares no code with Grove.
mod agent;
mod clauses;
mod covering;
mod formula;
mod instance;
mod joint;
mod json;
mod keys;
mod orders;
mod paths;
mod priced;
mod prices;
mod proof;
mod reader;
mod rules;
mod search;
mod successors;
mod tokens;

use std::alloc::{GlobalAlloc, Layout, System};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicU64, Ordering};
use std::time::{Duration, Instant};

const USAGE: &str = "Usage: grove-verify INSTANCE PROOF [--time-limit SECONDS] [--memory-limit GB] [--confine] [--clauses FILE] [--stats]
       grove-verify FILE.scen PROOF --agents N [--map FILE.map] ...

Verifies that a certificate proves its lower bound on the cost of every valid plan of the instance.

  --agents N             for a scenario: its first N rows are the agents.
  --map FILE.map         map of the scenario (default: the map that its rows name, in the same folder).
  --time-limit SECONDS   refuse after this time (default: no limit).
  --memory-limit GB      refuse when more memory is needed (default: 4). The window of zstd, at most 128 MiB, is not counted.
  --confine              refuse an instance that names a map or roadmap outside its own folder.
  --clauses FILE         write the clauses that the checker makes for a formula, in DIMACS format.
  --stats                print lines, nodes, lemmas, searches and time to standard error.

Exit codes: 0 'verified: ...', the bound is proven; 1 'refused: ...', it is not proven, or not within the limits;
2 'unreadable: ...', a file is not a certificate or not an instance, or an option is wrong.";

/// Number of the line that is being verified; static for refusals from outside the verifier (limits, panics).
static LINE: AtomicU64 = AtomicU64::new(0);
/// Number of bytes that are currently allocated.
static USED: AtomicU64 = AtomicU64::new(0);
/// Memory limit in bytes.
static LIMIT: AtomicU64 = AtomicU64::new(4_000_000_000);
static ENDED: AtomicBool = AtomicBool::new(false);

/// Prints a verdict and ends the program. Thread-safe. Only the first call has an effect; later calls wait for the program to end.
fn end(code: i32, text: &str) -> ! {
    if ENDED.swap(true, Ordering::SeqCst) { std::thread::sleep(Duration::from_secs(60)); }
    use std::io::Write;
    let _ = writeln!(std::io::stdout(), "{}", text);
    std::process::exit(code)
}

fn refuse(reason: &str) -> ! { end(1, &format!("refused: line {}: {}", LINE.load(Ordering::Relaxed), reason)) }

/// Allocator that counts the allocated bytes and refuses the certificate when they exceed LIMIT.
struct Counting;

unsafe impl GlobalAlloc for Counting {
    unsafe fn alloc(&self, layout: Layout) -> *mut u8 {
        let used = USED.fetch_add(layout.size() as u64, Ordering::Relaxed) + layout.size() as u64;
        if used > LIMIT.load(Ordering::Relaxed) && LIMIT.swap(u64::MAX, Ordering::Relaxed) != u64::MAX {
            refuse("the memory limit is reached");
        }
        System.alloc(layout)
    }

    unsafe fn dealloc(&self, pointer: *mut u8, layout: Layout) {
        USED.fetch_sub(layout.size() as u64, Ordering::Relaxed);
        System.dealloc(pointer, layout)
    }
}

#[global_allocator]
static ALLOCATOR: Counting = Counting;

struct Arguments {
    files: Vec<String>,
    agents: Option<u32>,
    map: Option<String>,
    seconds: Option<f64>,
    confine: bool,
    stats: bool,
    clauses: Option<String>,
}

fn arguments() -> Result<Arguments, String> {
    let mut found = Arguments { files: Vec::new(), agents: None, map: None, seconds: None, confine: false, stats: false, clauses: None };
    let mut words = std::env::args().skip(1);
    while let Some(word) = words.next() {
        let mut number = |max: f64| {
            let value = words.next().and_then(|word| word.parse().ok()).filter(|&value: &f64| value > 0.0 && value <= max);
            value.ok_or_else(|| format!("{}: expected a number above 0, at most {}", word, max))
        };
        match word.as_str() {
            "--time-limit" => found.seconds = Some(number(1e9)?),
            "--memory-limit" => LIMIT.store((number(1e6)? * 1e9) as u64, Ordering::Relaxed),
            "--agents" => found.agents = Some(number(1e9)?).filter(|n| n.fract() == 0.0).map(|n| n as u32),
            "--map" => found.map = Some(words.next().ok_or("--map: expected a file")?),
            "--confine" => found.confine = true,
            "--stats" => found.stats = true,
            "--clauses" => found.clauses = Some(words.next().ok_or("--clauses: expected a file")?),
            "--help" => {
                println!("{}", USAGE);
                std::process::exit(0);
            }
            option if option.starts_with("--") => return Err(format!("{}: unknown option", option)),
            _ => found.files.push(word),
        }
    }
    if found.files.len() != 2 { return Err("expected INSTANCE and PROOF".to_string()); }
    let scenario = found.files[0].ends_with(".scen");
    if scenario && found.agents.is_none() { return Err("a .scen file requires --agents with a whole number".to_string()); }
    if !scenario && (found.agents.is_some() || found.map.is_some()) { return Err("--agents and --map require a .scen file".to_string()); }
    Ok(found)
}

fn verify(arguments: &Arguments) -> (i32, String) {
    let begin = Instant::now();
    let instance = instance::Instance::read(Path::new(&arguments.files[0]), arguments.agents, arguments.map.as_deref().map(Path::new), arguments.confine);
    let lines = reader::Lines::open(Path::new(&arguments.files[1])).map_err(|error| format!("{}: {}", arguments.files[1], error));
    let (instance, lines) = match instance.and_then(|instance| Ok((instance, lines?))) {
        Ok(found) => found,
        Err(reason) => return (2, format!("unreadable: {}", reason)),
    };
    let mut verifier = proof::Verifier::new(instance, lines);
    verifier.clauses = arguments.clauses.clone();
    let outcome = verifier.run();
    if arguments.stats { eprintln!("{}, {:.3} s", verifier.statistics(), begin.elapsed().as_secs_f64()); }
    let line = LINE.load(Ordering::Relaxed);
    let of = if verifier.may_follow() { "" } else { ", where following is forbidden" };
    match outcome {
        Ok(Some(bound)) => (0, format!("verified: no plan costs less than {}{}", bound, of)),
        Ok(None) => (0, format!("verified: there is no plan{}", of)),
        Err((code, reason)) => (code, format!("{}: line {}: {}", if code == 1 { "refused" } else { "unreadable" }, line, reason)),
    }
}

fn main() {
    let arguments = arguments().unwrap_or_else(|reason| {
        eprintln!("grove-verify: error: {}\n\n{}", reason, USAGE);
        std::process::exit(2)
    });
    if let Some(seconds) = arguments.seconds {
        std::thread::spawn(move || {
            std::thread::sleep(Duration::from_secs_f64(seconds));
            refuse("the time limit is reached")
        });
    }
    std::panic::set_hook(Box::new(|panic| {
        let what = panic.payload();
        let what = what.downcast_ref::<String>().map(String::as_str).or_else(|| what.downcast_ref::<&str>().copied());
        refuse(&format!("beyond this checker: {}", what.unwrap_or("internal error")))
    }));
    // The thread has a large stack, because the covering search and the joint search recurse once per agent.
    let worker = std::thread::Builder::new().stack_size(1 << 29).spawn(move || verify(&arguments));
    let (code, text) = worker.expect("a thread").join().unwrap_or_else(|_| refuse("internal error"));
    end(code, &text)
}
