// Inputs at the edges of what is promised, and what has to hold for every result there, for any row of the table.
#pragma once

#include "support/inputs.h"

namespace vndf::testing {

/// From 1e-6 to 100; or 0 and what is next to it.
enum class Roughness { promised, tiny };

/// Drawn from literal edges and from all that is promised: views along the normal, close to it, on the horizon and
/// below it; alpha decades apart; leaning by right angles; u at the ends of [0, 1]; indices next to 1; light from
/// anywhere, and from where the view goes.
Table edge_inputs(const Operation& operation, Roughness roughness, std::size_t count, std::uint64_t seed);
/// Every combination of some literal edges.
Table grid_inputs(const Operation& operation);

/// Results, and the samples' evaluations, which have their own row, are finite and in range; unit vectors are unit; and
/// what comes out at the wrong side of the surface counts nothing. Lengths are those of unit views, and of alpha that
/// is promised.
void expect_sound(const Operation& operation, const Table& in, const Table& out, Roughness roughness);
/// The same for the row's evaluation of its samples. Columns are those of `in`, or constants of the same values.
void expect_sound(const Operation& operation, const Table& in, const std::vector<Column>& columns, Roughness roughness);

/// The two heuristics of multiple importance sampling, as renderers write them, of a density and of another.
bool survives_heuristics(float pdf);

}  // namespace vndf::testing
