#include "server/serve.h"

#include <malloc.h>

#include <memory>

#include "cli/command.h"
#include "cli/settings.h"
#include "server/settings.h"

namespace farol::cli {
namespace {

/// Adds the flag of a setting whose value is kept in `options`.
class FlagAdder {
  public:
    FlagAdder(CLI::App& command, const server::Setting& setting)
        : command_(command), setting_(setting), name_("--" + setting.name) {}

    template <typename Number>
    void operator()(Number* value) const {
        takesNumber(command_.add_option(name_, *value, setting_.help), setting_.min, setting_.max);
    }
    void operator()(bool* value) const { command_.add_flag(name_, *value, setting_.help); }
    void operator()(std::string* value) const {
        CLI::Option* option = command_.add_option(name_, *value, setting_.help);
        option->type_name(setting_.form);
        if (!setting_.words.empty()) option->check(CLI::IsMember(setting_.words));
        if (!value->empty()) option->capture_default_str();
    }
    /// Times are read as seconds and become the server's milliseconds.
    void operator()(std::chrono::milliseconds* value) const {
        const auto set = [value](double seconds) {
            *value = std::chrono::milliseconds(static_cast<std::int64_t>(seconds * 1000.0));
        };
        CLI::Option* option = command_.add_option_function<double>(name_, set, setting_.help);
        takesNumber(option, setting_.min, setting_.max);
        option->default_str(server::defaultText(setting_));
    }

  private:
    CLI::App& command_;
    const server::Setting& setting_;
    std::string name_;
};

int run(const server::ServeOptions& options) {
    // Images are allocated by one thread and freed by another, which fragments malloc's heaps of
    // the threads. Two heaps do not slow down responses from the cache.
    ::mallopt(M_ARENA_MAX, 2);
    // Bodies and large images go back to the system when they are freed. By default, malloc
    // raises this threshold to the largest block it has freed.
    ::mallopt(M_MMAP_THRESHOLD, 1 << 20);
    try {
        return server::serve(options) == 0 ? kDone : kInternal;
    } catch (const Error& error) {
        throw UsageError(error.primary());  // the input of serve is its flags
    }
}

}  // namespace

void addServe(CLI::App& root, Action& action) {
    CLI::App* command = root.add_subcommand("serve", "Answers HTTP requests until SIGTERM or ^C");
    const auto options = std::make_shared<server::ServeOptions>();
    for (const server::Setting& setting : server::settings())
        std::visit(FlagAdder(*command, setting), setting.target(*options));
    addSettings(*command);
    command->callback([&action, command, options] {
        readSettings(*command);
        action = [options](Report&) { return run(*options); };
    });
}

}  // namespace farol::cli
