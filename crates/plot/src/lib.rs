//! Pictures of the bouncing elastic rod as SVG, and with the feature `raster` as PNG and PDF.
//!
//! - [`Drawing`] draws one [history](dalembert::TypedHistory) in doubles.
//! - [`Request`] and [`SceneData`] draw chosen pictures of one or several scenes.
//! - [`RodPicture`] draws the rod at one time.
//! - [`draw`] has panels, axes and layers for other data.
//!
//! A rod of length 1 hits the ground with the speed μ = 3. Its wave runs up and back in `t₁ = 2`, while gravity
//! compresses the lower end further.
//!
//! ```
//! use dalembert::{Problem, Units};
//! use dalembert_plot::Drawing;
//!
//! let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
//! let history = rod.doubles()?;
//! let drawing = Drawing { span: Some([0.0, 4.0]), ..Drawing::default() };
//! let drawn = drawing.draw(&history, Units::default())?;
//! // Field, stress, motion and energy.
//! assert_eq!(drawn.svg.matches("class=\"panel\"").count(), 4);
//! // The greatest strain is at the ground, at the end of the contact: (μ + g t₁)/c = 5.
//! assert_eq!(drawn.color_limit, 5.0);
//! # Ok::<(), dalembert::Error>(())
//! ```

pub mod draw;
mod drawing;
mod field;
mod panels;
mod picture;
mod rigid;
mod rod;
mod scene_data;

pub use draw::Canvas;
pub use drawing::{Drawing, DrawnSvg, heights};
pub use panels::UnitsDiffer;
pub use picture::{FieldQuantity, Picture, UnknownPicture};
pub use rod::{RodPicture, RunExtremes};
pub use scene_data::{Request, SceneData};
