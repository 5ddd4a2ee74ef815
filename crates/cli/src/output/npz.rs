//! NPZ: one array for each column, for NumPy.

use std::io::{self, Seek, Write};

use ndarray::ArrayD;
use ndarray_npy::{NpzWriter, WritableElement, WriteNpzError};

pub(super) struct Npz<W: Write + Seek>(NpzWriter<W>);

fn failed(error: WriteNpzError) -> io::Error {
    io::Error::other(error.to_string())
}

impl<W: Write + Seek> Npz<W> {
    pub(super) fn new(to: W, compressed: bool) -> Self {
        Npz(if compressed { NpzWriter::new_compressed(to) } else { NpzWriter::new(to) })
    }

    pub(super) fn add<T: WritableElement>(&mut self, name: &str, shape: &[usize], values: Vec<T>) -> io::Result<()> {
        let array = ArrayD::from_shape_vec(shape, values).map_err(io::Error::other)?;
        self.0.add_array(name, &array).map_err(failed)
    }

    pub(super) fn finish(self) -> io::Result<()> {
        self.0.finish().map(drop).map_err(failed)
    }
}
