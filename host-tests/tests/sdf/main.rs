//! Distance fields: the interval of every point is that of the stored numbers, whatever the bytes.

mod bytes;
mod kernel;
