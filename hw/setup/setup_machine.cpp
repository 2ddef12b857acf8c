#include "hw/setup/setup_machine.h"

#include "hw/rig/open_rig.h"

namespace flytri::setup {

SetupMachine this_machine() {
  return {rig::machine_drivers(), gpio::list_chips, rig::open_devices, rig::open_rig,
          device::machine_clock()};
}

Result<std::size_t> SetupContext::choose(const std::string& question,
                                         const std::vector<std::string>& answers,
                                         std::size_t suggested) const {
  const auto answer = talk.choose(question, answers, suggested);
  if (!answer || progress.cancelled()) return stopped();
  return *answer;
}

}  // namespace flytri::setup
