#pragma once

#include "scene/scene.hpp"

namespace vlbeam::test {

/// A scene whose strains are the papers', for tests whose references and digits are for them.
inline Scene by_greens_law() {
  Scene scene;
  scene.beam.strain_law = StrainLaw::green;
  return scene;
}

}  // namespace vlbeam::test
