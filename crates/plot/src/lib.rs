//! Pictures of the bouncing elastic rod as SVG, and with the feature `raster` as PNG and PDF.
//!
//! - [`Drawing`] draws one [`History`](dalembert::History).
//! - [`Request`] and [`SceneData`] draw chosen pictures of one or several scenes.
//! - [`RodPicture`] draws the rod at one time.
//! - [`draw`] has panels, axes and layers for other data.
//!
//! A rod of length 1 falls with the speed 3: its wave runs up and back in `t₁ = 2`, and the contact ends then.
//!
//! ```
//! use dalembert::{Problem, Units};
//! use dalembert_plot::Drawing;
//!
//! let rod = Problem::builder().length(1).wave_speed(1).gravity(1).impact_speed(3).build()?;
//! let history = rod.solve()?;
//! let drawing = Drawing { span: Some([0.0, 4.0]), ..Drawing::default() };
//! let drawn = drawing.draw(&history, &rod, Units::default())?;
//! // Field, stress, motion and energy.
//! assert_eq!(drawn.svg.matches("class=\"panel\"").count(), 4);
//! // The greatest strain is μ/c = 3, at the ground.
//! assert_eq!(drawn.color_limit, 3.0);
//! # Ok::<(), dalembert::Error>(())
//! ```

pub mod draw;
mod drawing;
mod field;
mod panels;
mod picture;
mod rod;
mod scene_data;

pub use draw::Canvas;
pub use drawing::{Drawing, DrawnSvg};
pub use panels::UnitsDiffer;
pub use picture::{FieldQuantity, Picture, UnknownPicture};
pub use rod::{RodPicture, RunExtremes};
pub use scene_data::{Request, SceneData};
