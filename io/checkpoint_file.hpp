#pragma once

#include <filesystem>

#include "mechanics/time/checkpoint.hpp"
#include "scene/scene.hpp"

namespace vlbeam {

/// Writes what a run of `scene` can go on from: CBOR, with the scene and the program it belongs to, and a checksum. It
/// replaces an earlier one only once it is whole. Throws std::runtime_error where it cannot be written.
void write_checkpoint(const std::filesystem::path& file, const Scene& scene, const Checkpoint& checkpoint);

/// Reads it. Throws InvalidInput, naming the file, if it is truncated, damaged, no checkpoint at all, of another
/// scene (the message names what differs), or of another build of the program, whose digits may be other ones.
Checkpoint read_checkpoint(const std::filesystem::path& file, const Scene& scene);

}  // namespace vlbeam
