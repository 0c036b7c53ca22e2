// Runs a scene file, prints how it went and where the mass is, and writes the report.
//   run_scene SCENE.json [REPORT.json]
#include <fstream>
#include <iostream>

#include <vlbeam/vlbeam.hpp>

int main(int argc, char** argv) {
  if (argc < 2) {
    std::cerr << "usage: run_scene SCENE.json [REPORT.json]\n";
    return 2;
  }
  try {
    const vlbeam::Scene scene = vlbeam::read_scene(argv[1]);
    const vlbeam::RunResult result = vlbeam::simulate(scene);
    std::cout << vlbeam::run_summary(scene, result);

    // The samples are plain numbers: here the largest force between beam and mass.
    double largest = 0, when = 0;
    for (const vlbeam::Sample& sample : result.samples) {
      if (sample.joint && sample.joint->normal > largest) {
        largest = sample.joint->normal;
        when = sample.t;
      }
    }
    std::cout << "  largest force   " << largest << " N at t = " << when << " s\n";
    if (argc > 2) std::ofstream(argv[2]) << vlbeam::report(scene, result);
    return result.status == vlbeam::RunStatus::failed ? 3 : 0;
  } catch (const vlbeam::InvalidInput& error) {  // names the key, what stands there, and what may
    std::cerr << error.what() << '\n';
    return 2;
  }
}
