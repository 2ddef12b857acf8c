#include "app/cli/guide_dialog.h"

#include <fmt/format.h>

#include <charconv>
#include <cstdio>
#include <utility>

#include "app/cli/console.h"
#include "app/cli/prompt.h"

namespace flytri::cli {
namespace {

enum class Answer { kTake, kBack, kPlane, kStop, kUnknown };

struct Choice {
  Answer answer = Answer::kUnknown;
  std::size_t plane = 0;  ///< of kPlane, from 0
};

Choice understand(const std::optional<std::string>& line, std::size_t plane_count) {
  if (!line || *line == "q") return {Answer::kStop};
  if (line->empty()) return {Answer::kTake};
  if (*line == "s") return {Answer::kBack};
  std::size_t plane = 0;
  const char* end = line->data() + line->size();
  const auto read = std::from_chars(line->data(), end, plane);
  if (read.ec != std::errc() || read.ptr != end || plane < 1 || plane > plane_count) return {};
  return {Answer::kPlane, plane - 1};
}

std::string describe(const calibration::WantedShot& shot,
                     const calibration::GuidedCalibration& guide) {
  return fmt::format("{} of {}: put the {} at z = {:+.2f} mm (plane {}).", shot.placement + 1,
                     guide.placements().size(), to_string(shot.place.face), shot.z_mm,
                     shot.place.plane + 1);
}

void print(const shots::ShotOutcome& outcome) {
  const calibration::ShotFigures& figures = outcome.verdict.figures;
  print_out("  {:<22}", to_string(outcome.shot.kind));
  if (!outcome.verdict.good()) {
    print_out("REFUSED: {}\n    {}\n", outcome.verdict.finding,
              calibration::remedy_of(outcome.verdict.fault));
  } else if (figures.found > 0) {
    print_out("good: {} found, brightness {:.0f} %, edges {:.1f} px\n", figures.found,
              100 * figures.brightness, figures.width_px);
  } else {
    print_out("good\n");
  }
  std::fflush(stdout);
}

/// Both targets of the plane will be taken again.
Result<void> reopen_plane(shots::GuidedSession& session, std::size_t plane) {
  const auto& placements = session.guide().placements();
  for (std::size_t i = 0; i < placements.size(); ++i) {
    if (placements[i].plane != plane) continue;
    if (auto reopened = session.reopen(i); !reopened) return reopened;
  }
  return {};
}

Result<void> go_back(shots::GuidedSession& session) {
  const auto before = session.guide().placement_before();
  if (!before) return {};
  return session.reopen(*before);
}

/// @return  false: stop
Result<bool> obey(const Choice& choice, shots::GuidedSession& session, const Progress& progress) {
  Result<void> done;
  switch (choice.answer) {
    case Answer::kStop:
      return false;
    case Answer::kTake:
      if (session.guide().wanted()) {
        done = session.shoot_placement([](const shots::ShotOutcome& outcome) { print(outcome); },
                                       progress);
      }
      break;
    case Answer::kBack:
      done = go_back(session);
      break;
    case Answer::kPlane:
      done = reopen_plane(session, choice.plane);
      break;
    case Answer::kUnknown:
      print_out(
          "  Press Enter to take the images, s to go one step back, a number to take that plane "
          "again, q to stop and keep what is done.\n");
  }
  if (!done) return tl::unexpected(done.error());
  return true;
}

}  // namespace

Result<std::optional<calibration::GuidedFit>> run_guide_dialog(shots::GuidedSession& session,
                                                               const std::string& note,
                                                               const Workers& workers,
                                                               const Progress& progress) {
  Prompt prompt(progress);
  const std::size_t planes = session.guide().plan().z_mm.size();
  print_out(
      "Press Enter to take the images, s to go one step back, a number to take that plane again, "
      "q to stop and keep what is done.\n");
  while (true) {
    std::string question = "Which plane do you want to take again? ";
    if (const auto shot = session.guide().wanted()) {
      question = describe(*shot, session.guide()) + " ";
    } else {
      auto fit = session.finish(workers, progress, note);
      if (fit) return std::optional(*std::move(fit));
      if (!shots::is_refusal(fit.error())) return tl::unexpected(fit.error());
      print_out("REFUSED: {}\n", fit.error().message);
    }
    const auto line = prompt.ask(question);
    if (line) print_out("\n");
    const auto goes_on = obey(understand(line, planes), session, progress);
    if (!goes_on) return tl::unexpected(goes_on.error());
    if (!*goes_on) return std::optional<calibration::GuidedFit>{};
  }
}

}  // namespace flytri::cli
