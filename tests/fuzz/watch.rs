//! What a reader may take: memory by the length of the input, and time.

use std::{
    cell::Cell,
    fmt::Display,
    io::Write,
    panic::{AssertUnwindSafe, catch_unwind, resume_unwind},
    path::{Path, PathBuf},
    process,
    sync::{Mutex, MutexGuard, Once, PoisonError},
    thread,
    time::{Duration, Instant},
};

use peak_alloc::PeakAlloc;

#[global_allocator]
static HEAP: PeakAlloc = PeakAlloc;

/// What a scene may take however short its file is, to read, and in all: buffers of files, the small files beside it,
/// and what tracing keeps.
pub const CONSTANT: [usize; 2] = [256 << 10, 2 << 20];

/// Much longer than any input takes, on a machine that has other things to do.
const PATIENCE: Duration = Duration::from_secs(120);

/// Bytes that an input may take beyond [`CONSTANT`], to read it, and with compiling and tracing.
pub type Memory = fn(&[u8]) -> [usize; 2];

/// The input that is run.
struct Running {
    number: u64,
    file: PathBuf,
    since: Instant,
    limit: usize,
}

static RUNNING: Mutex<Option<Running>> = Mutex::new(None);

/// The heap is the whole program's, so one test runs at a time.
static ALONE: Mutex<()> = Mutex::new(());

pub struct Watch {
    format: &'static str,
    most: Cell<[f64; 2]>,
    slowest: Cell<(f64, u64)>,
    _alone: MutexGuard<'static, ()>,
}

pub fn alone() -> MutexGuard<'static, ()> {
    ALONE.lock().unwrap_or_else(PoisonError::into_inner)
}

impl Watch {
    pub fn new(format: &'static str) -> Self {
        static GUARD: Once = Once::new();
        GUARD.call_once(|| drop(thread::spawn(guard)));
        Self { format, most: Cell::default(), slowest: Cell::default(), _alone: alone() }
    }

    /// Runs input `number`, which is in `file`; `run` says when it has been read.
    pub fn over<T>(
        &self,
        number: u64,
        file: &Path,
        bytes: &[u8],
        memory: Memory,
        run: impl FnOnce(&dyn Fn()) -> T,
    ) -> T {
        let what = format!("{} {number} ({})", self.format, file.display());
        let since = Instant::now();
        let (length, memory) = (bytes.len(), memory(bytes));
        let limit = [0, 1].map(|part| CONSTANT[part] + memory[part]);
        let before = HEAP.current_usage();
        *running() = Some(Running { number, file: file.into(), since, limit: before + limit[1] });
        HEAP.reset_peak_usage();
        let taken = || HEAP.peak_usage().saturating_sub(before);
        let reading = Cell::new(None);
        let ran = catch_unwind(AssertUnwindSafe(|| run(&|| reading.set(Some(taken())))));
        let all = taken();
        *running() = None;
        let ran = ran.unwrap_or_else(|panic| {
            report(format_args!("{what}: panicked"));
            resume_unwind(panic)
        });
        let seconds = since.elapsed().as_secs_f64();
        if seconds > self.slowest.get().0 {
            self.slowest.set((seconds, number));
        }
        let reading = reading.get().unwrap_or(all);
        let most = self.most.get();
        self.most.set([0, 1].map(|part| {
            let multiple = [reading, all][part].saturating_sub(CONSTANT[part]) as f64 / length.max(1) as f64;
            multiple.max(most[part])
        }));
        assert!(reading <= limit[0], "{what}: reading {length} bytes took {reading}");
        assert!(all <= limit[1], "{what}: {length} bytes took {all}");
        ran
    }

    /// The most bytes a byte of an input beyond the constant: to read it, and in all.
    pub fn most(&self) -> [f64; 2] {
        self.most.get()
    }

    /// How many seconds the slowest input took, and its number.
    pub fn slowest(&self) -> (f64, u64) {
        self.slowest.get()
    }
}

fn running() -> MutexGuard<'static, Option<Running>> {
    RUNNING.lock().unwrap_or_else(PoisonError::into_inner)
}

/// Ends the program when an input takes too long, or so much memory that the machine would suffer.
fn guard() {
    loop {
        thread::sleep(Duration::from_millis(20));
        let Some(Running { number, file, since, limit }) = &*running() else { continue };
        let (taken, seconds) = (HEAP.current_usage(), since.elapsed().as_secs());
        if taken > *limit || since.elapsed() > PATIENCE {
            report(format_args!("input {number} ({}) takes {taken} bytes and {seconds} s", file.display()));
            process::exit(101);
        }
    }
}

/// Past the test harness, which would keep it until the test ends.
fn report(what: impl Display) {
    let _ = writeln!(std::io::stderr(), "{what}");
}
