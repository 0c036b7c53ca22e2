#pragma once

#include <string>
#include <vector>

#include "io/json.hpp"

namespace vlbeam {

/// A scene made of another program's input, and what of that input it does not have.
struct ImportedScene {
  Json scene;
  std::vector<std::string> left_out;  ///< a sentence each
};

/// Reads an input of MoorDyn (versions 1 and 2): types of lines, points, lines, options. Lines become ropes at rest in
/// still water, of one scene in their vertical plane or in space; fixed and coupled points hold, free ones are bodies
/// or pins. A line is drawn with its unstretched length: over the seabed where it is slack; where it is shorter than
/// the distance of its points, a support stretches it. Throws InvalidInput, with the line of the file, for what is not
/// understood, and for rods and bodies, without which it would be another system.
ImportedScene scene_of_moordyn(const std::string& text);

}  // namespace vlbeam
