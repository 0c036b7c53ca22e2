// The reader of reports: any file is a report whose columns and shapes can be read, or InvalidInput.
#include <sys/mman.h>
#include <unistd.h>

#include <cstdint>
#include <cstdlib>
#include <string>

#include "io/run_file.hpp"

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const int file = ::memfd_create("report", 0);
  if (file < 0 || ::write(file, data, size) != static_cast<ssize_t>(size)) std::abort();
  try {
    const vlbeam::RunFile report = vlbeam::read_run_file("/proc/self/fd/" + std::to_string(file));
    for (const vlbeam::Quantity& quantity : vlbeam::quantities(report.scene)) {
      try {
        report.column(quantity);
      } catch (const vlbeam::InvalidInput&) {
      }
    }
    report.configurations();
  } catch (const vlbeam::InvalidInput&) {
  }
  ::close(file);
  return 0;
}
