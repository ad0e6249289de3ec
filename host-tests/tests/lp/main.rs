//! The linear program of a hull's vertex.

mod invariance;
mod oracle;
mod orders;
mod regularised;

use meshsweep::lp::Order;

/// Every order of insertion: what one shows, each shows.
const ORDERS: [Order; 3] = [Order::MostViolated, Order::Shuffled(0), Order::Shuffled(1)];
