#include <systemd/sd-bus.h>
#include <unistd.h>

#include <cstring>
#include <string>
#include <utility>

#include "app/desktop/file_chooser.h"
#include "app/desktop/file_uri.h"

namespace flytri::desktop {
namespace {

constexpr const char* kPortal = "org.freedesktop.portal.Desktop";
constexpr const char* kPortalPath = "/org/freedesktop/portal/desktop";
constexpr const char* kChooserInterface = "org.freedesktop.portal.FileChooser";
constexpr const char* kRequestInterface = "org.freedesktop.portal.Request";

template <auto kFree>
struct Unref {
  template <typename T>
  void operator()(T* object) const {
    kFree(object);
  }
};
using Bus = std::unique_ptr<sd_bus, Unref<sd_bus_close_unref>>;
using Slot = std::unique_ptr<sd_bus_slot, Unref<sd_bus_slot_unref>>;
using Message = std::unique_ptr<sd_bus_message, Unref<sd_bus_message_unref>>;

/// Bytes with an ending zero, as the portal wants paths.
int append_path(sd_bus_message* message, const char* key, const std::string& path) {
  int code = sd_bus_message_open_container(message, 'e', "sv");
  if (code >= 0) code = sd_bus_message_append(message, "s", key);
  if (code >= 0) code = sd_bus_message_open_container(message, 'v', "ay");
  if (code >= 0) code = sd_bus_message_append_array(message, 'y', path.c_str(), path.size() + 1);
  if (code >= 0) code = sd_bus_message_close_container(message);
  return code >= 0 ? sd_bus_message_close_container(message) : code;
}

/// Where the dialog begins, and the name that it proposes.
int append_place(sd_bus_message* message, const ChooserQuestion& question) {
  if (question.now.empty()) return 0;
  std::error_code unknown;
  const bool is_folder = std::filesystem::is_directory(question.now, unknown);
  const auto folder = is_folder ? question.now : question.now.parent_path();
  int code = 0;
  if (std::filesystem::is_directory(folder, unknown)) {
    code = append_path(message, "current_folder", folder.string());
  }
  if (code < 0 || is_folder || question.kind != ChooserKind::kSaveFile) return code;
  return sd_bus_message_append(message, "{sv}", "current_name", "s",
                               question.now.filename().c_str());
}

int append_options(sd_bus_message* message, const ChooserQuestion& question,
                   const std::string& token) {
  int code = sd_bus_message_open_container(message, 'a', "{sv}");
  if (code >= 0) {
    code = sd_bus_message_append(message, "{sv}", "handle_token", "s", token.c_str());
  }
  if (code >= 0 && question.kind == ChooserKind::kFolder) {
    code = sd_bus_message_append(message, "{sv}", "directory", "b", 1);
  }
  if (code >= 0 && !question.filter_glob.empty()) {
    code = sd_bus_message_append(message, "{sv}", "filters", "a(sa(us))", 1,
                                 question.filter_name.c_str(), 1, 0U, question.filter_glob.c_str());
  }
  if (code >= 0) code = append_place(message, question);
  return code >= 0 ? sd_bus_message_close_container(message) : code;
}

/// The first of the URIs in the results of a Response.
std::string first_uri(sd_bus_message* message) {
  if (sd_bus_message_enter_container(message, 'a', "{sv}") < 0) return {};
  while (sd_bus_message_enter_container(message, 'e', "sv") > 0) {
    const char* key = nullptr;
    if (sd_bus_message_read(message, "s", &key) < 0) return {};
    if (std::strcmp(key, "uris") == 0) {
      const char* uri = nullptr;
      if (sd_bus_message_enter_container(message, 'v', "as") < 0 ||
          sd_bus_message_enter_container(message, 'a', "s") < 0 ||
          sd_bus_message_read(message, "s", &uri) <= 0) {
        return {};
      }
      return uri;
    }
    if (sd_bus_message_skip(message, "v") < 0 || sd_bus_message_exit_container(message) < 0) {
      return {};
    }
  }
  return {};
}

/// Speaks D-Bus by libsystemd, not by libportal: that would need GLib and its main loop, while this
/// library is part of every Debian and one call a frame of the window is enough.
class PortalFileChooser final : public FileChooser {
 public:
  PortalFileChooser() { connect(); }
  [[nodiscard]] std::string why_not() const override { return why_not_; }
  [[nodiscard]] Result<void> ask(const ChooserQuestion& question) override;
  [[nodiscard]] std::optional<ChooserAnswer> settle() override;

 private:
  void connect();
  void give_up(std::string why);
  /// The portal tells where its answer will come from: newer ones use a path that is known before.
  [[nodiscard]] int expect_answer(const std::string& path);
  [[nodiscard]] std::string request_path(const std::string& token) const;
  void end(ChooserAnswer answer);

  static int take_names(sd_bus_message* message, void* self, sd_bus_error* error);
  static int take_reply(sd_bus_message* message, void* self, sd_bus_error* error);
  static int take_response(sd_bus_message* message, void* self, sd_bus_error* error);

  // Destroyed before the bus.
  Bus bus_;
  Slot names_, reply_, response_;
  std::string why_not_ = "The desktop is being asked for its file dialog; type the path meanwhile";
  std::string expected_path_;
  bool is_open_ = false;
  int asked_ = 0;
  std::optional<ChooserAnswer> answer_;
};

void PortalFileChooser::give_up(std::string why) {
  why_not_ = std::move(why);
  names_.reset();
  reply_.reset();
  response_.reset();
  bus_.reset();
  if (is_open_) end({std::nullopt, why_not_});
}

void PortalFileChooser::connect() {
  sd_bus* opened = nullptr;
  if (sd_bus_open_user(&opened) < 0) {
    return give_up("This desktop offers no file dialog (no D-Bus session); type the path");
  }
  bus_.reset(opened);
  sd_bus_slot* slot = nullptr;
  if (sd_bus_call_method_async(bus_.get(), &slot, "org.freedesktop.DBus", "/org/freedesktop/DBus",
                               "org.freedesktop.DBus", "ListActivatableNames", take_names, this,
                               "") < 0) {
    return give_up("This desktop offers no file dialog (D-Bus does not answer); type the path");
  }
  names_.reset(slot);
}

int PortalFileChooser::take_names(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
  auto& chooser = *static_cast<PortalFileChooser*>(self);
  bool is_there = false;
  if (sd_bus_message_is_method_error(message, nullptr) == 0 &&
      sd_bus_message_enter_container(message, 'a', "s") > 0) {
    for (const char* name = nullptr; sd_bus_message_read(message, "s", &name) > 0;) {
      is_there = is_there || std::strcmp(name, kPortal) == 0;
    }
  }
  chooser.why_not_ = is_there ? ""
                              : "This desktop offers no file dialog; install xdg-desktop-portal "
                                "with a backend, or type the path";
  return 0;
}

std::string PortalFileChooser::request_path(const std::string& token) const {
  const char* unique = nullptr;
  if (sd_bus_get_unique_name(bus_.get(), &unique) < 0 || unique == nullptr) return {};
  std::string sender = unique + 1;
  for (char& c : sender) c = c == '.' ? '_' : c;
  return std::string(kPortalPath) + "/request/" + sender + "/" + token;
}

int PortalFileChooser::expect_answer(const std::string& path) {
  if (path == expected_path_) return 0;
  expected_path_ = path;
  sd_bus_slot* slot = nullptr;
  const int code =
      sd_bus_match_signal_async(bus_.get(), &slot, kPortal, path.c_str(), kRequestInterface,
                                "Response", take_response, nullptr, this);
  if (code >= 0) response_.reset(slot);
  return code;
}

Result<void> PortalFileChooser::ask(const ChooserQuestion& question) {
  if (!why_not_.empty()) return fail(ErrorCode::kNotFound, "{}", why_not_);
  if (is_open_) return fail(ErrorCode::kBadOption, "the file dialog is open already");
  const std::string token = "flytri" + std::to_string(::getpid()) + "_" + std::to_string(++asked_);
  const std::string path = request_path(token);
  sd_bus_message* call = nullptr;
  const bool saves = question.kind == ChooserKind::kSaveFile;
  int code = expect_answer(path);
  if (code >= 0) {
    code = sd_bus_message_new_method_call(bus_.get(), &call, kPortal, kPortalPath,
                                          kChooserInterface, saves ? "SaveFile" : "OpenFile");
  }
  const Message owned(call);
  if (code >= 0) code = sd_bus_message_append(call, "ss", "", question.title.c_str());
  if (code >= 0) code = append_options(call, question, token);
  sd_bus_slot* slot = nullptr;
  // The reply comes at once, the answer when the user has chosen.
  if (code >= 0) code = sd_bus_call_async(bus_.get(), &slot, call, take_reply, this, 0);
  if (code < 0) {
    return fail(ErrorCode::kNotFound,
                "the desktop's file dialog cannot be opened: {}; type the "
                "path",
                std::strerror(-code));
  }
  reply_.reset(slot);
  is_open_ = true;
  return {};
}

int PortalFileChooser::take_reply(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
  auto& chooser = *static_cast<PortalFileChooser*>(self);
  if (const sd_bus_error* error = sd_bus_message_get_error(message); error != nullptr) {
    const std::string why = error->message == nullptr ? error->name : error->message;
    chooser.end({std::nullopt, "The desktop's file dialog does not open: " + why});
    return 0;
  }
  const char* path = nullptr;
  if (sd_bus_message_read(message, "o", &path) >= 0) (void)chooser.expect_answer(path);
  return 0;
}

int PortalFileChooser::take_response(sd_bus_message* message, void* self, sd_bus_error* /*error*/) {
  auto& chooser = *static_cast<PortalFileChooser*>(self);
  if (!chooser.is_open_) return 0;
  constexpr std::uint32_t kChosen = 0;
  std::uint32_t outcome = 2;
  if (sd_bus_message_read(message, "u", &outcome) < 0 || outcome != kChosen) {
    chooser.end({});
    return 0;
  }
  const std::string uri = first_uri(message);
  const auto path = path_of_uri(uri);
  chooser.end(path ? ChooserAnswer{*path, ""}
                   : ChooserAnswer{std::nullopt, uri + ": is not a file on this computer"});
  return 0;
}

void PortalFileChooser::end(ChooserAnswer answer) {
  is_open_ = false;
  answer_ = std::move(answer);
}

std::optional<ChooserAnswer> PortalFileChooser::settle() {
  // Each call handles one message and does not wait.
  int code = 0;
  while (bus_ != nullptr && (code = sd_bus_process(bus_.get(), nullptr)) > 0) {
  }
  if (code < 0) give_up("The connection to the desktop is broken; type the path");
  return std::exchange(answer_, std::nullopt);
}

}  // namespace

std::unique_ptr<FileChooser> portal_file_chooser() { return std::make_unique<PortalFileChooser>(); }

}  // namespace flytri::desktop
