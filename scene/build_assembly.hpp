#pragma once

#include <memory>
#include <vector>

#include "mechanics/assembly/assembly.hpp"
#include "scene/assembly.hpp"

namespace vlbeam {

/// Where an end of a link is at t = 0 [m].
Point place_of(const Scene& whole, const LinkEndSpec& end);

/// Whether two beams of one section are one beam where a clamp joins them.
bool are_one_beam(const Scene& whole, const LinkEndSpec& a, const LinkEndSpec& b);

template <int D>
BodyModel<D> build_body(const Scene& whole, const BodySpec& body);

/// What a link of the scene ties; members are the beams, then the bodies.
template <int D>
Link<D> build_link(const Scene& whole, const LinkSpec& link);

}  // namespace vlbeam
