/// @file  flytri app: the window.
#include <memory>
#include <vector>

#include "app/cli/commands.h"
#include "app/session/session.h"
#include "ui/app_window.h"

namespace flytri::cli {
namespace {

struct AppArguments {
  SourceChoice source;
  ui::AppWindowOptions window;
};

Result<void> run(const AppArguments& arguments) {
  auto window = ui::AppWindow::create(arguments.window);
  if (!window) return tl::unexpected(window.error());
  SessionOptions options;
  options.source = arguments.source;
  Session session(options);
  session.carry_out(ui::StartScan{});
  std::vector<ui::Command> commands;
  bool is_open = true;
  while (is_open && !session.is_closing()) {
    is_open = (*window)->frame(session.view(), commands);
    for (const ui::Command& command : commands) session.carry_out(command);
    commands.clear();
  }
  return {};
}

}  // namespace

void add_app_command(CLI::App& app, Invocation& invocation) {
  const auto arguments = std::make_shared<AppArguments>();
  CLI::App* command = app.add_subcommand(
      "app", "Open the scanning window; without any subcommand this is what flytri does");
  command->add_option("--mesh", arguments->source.mesh,
                      "What the virtual sensor scans instead of the sample jaw (.ply, .glb)");
  command->add_option("--control", arguments->window.control_socket,
                      "Unix socket on which tests and pictures steer the window");
  command->footer("Example: flytri app");
  command->callback([arguments, &invocation] {
    invocation.job = [arguments](const Progress&) { return run(*arguments); };
  });
}

}  // namespace flytri::cli
