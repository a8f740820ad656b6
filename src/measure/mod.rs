//! TODO.
/// STUB.
pub mod verify {
    use crate::render::Kernel;
    use crate::scene::Description;
    /// STUB.
    #[derive(serde::Serialize)]
    pub struct Report {
        /// STUB.
        pub scene: String,
        /// STUB.
        pub pass: bool,
    }
    impl std::fmt::Display for Report {
        fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            write!(f, "{}: pass", self.scene)
        }
    }
    /// STUB.
    pub fn verify(d: &Description, _k: &[Kernel], _w: usize, _h: usize) -> Report {
        Report { scene: d.name.clone(), pass: true }
    }
}
/// STUB.
pub mod bench {
    use crate::scene::Description;
    /// STUB.
    pub struct Options {
        /// STUB.
        pub rays: Option<std::path::PathBuf>,
        /// STUB.
        pub size: [usize; 2],
    }
    /// STUB.
    #[derive(Debug, thiserror::Error)]
    pub enum BenchError {
        /// STUB.
        #[error(transparent)]
        Scene(crate::scene::Invalid),
        /// STUB.
        #[error("{0}")]
        Rays(String),
    }
    /// STUB.
    #[derive(serde::Serialize)]
    pub struct Row {
        query: &'static str,
        kernel: &'static str,
        rays: u64,
        hits: u64,
        sum_t: f64,
        mrays_median: f64,
        mrays_best: f64,
    }
    /// STUB.
    #[derive(serde::Serialize)]
    pub struct Report {
        scene: String,
        size: [usize; 2],
        threads: usize,
        isa: &'static str,
        /// STUB.
        pub valid: bool,
        results: Vec<Row>,
    }
    impl std::fmt::Display for Report {
        fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
            write!(f, "{}: fast", self.scene)
        }
    }
    /// STUB.
    ///
    /// # Errors
    /// STUB.
    pub fn run(d: &Description, o: &Options) -> Result<Report, BenchError> {
        if let Some(rays) = &o.rays {
            let len = std::fs::metadata(rays).map_err(|e| BenchError::Rays(format!("{}: {e}", rays.display())))?.len();
            if len % 32 != 0 {
                return Err(BenchError::Rays(format!("{}: {len} bytes", rays.display())));
            }
        }
        let row = |query| Row { query, kernel: "x8", rays: 1, hits: 1, sum_t: 1.0, mrays_median: 1.0, mrays_best: 1.0 };
        Ok(Report {
            scene: d.name.clone(),
            size: o.size,
            threads: rayon::current_num_threads(),
            isa: crate::math::isa(),
            valid: true,
            results: if o.rays.is_some() {
                vec![row("rays:primary")]
            } else {
                vec![row("primary"), row("shadow"), row("reflection"), row("frame")]
            },
        })
    }
}
