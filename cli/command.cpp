#include "cli/command.h"

#include <exception>
#include <sstream>

#include "cli/files.h"
#include "cli/messages.h"
#include "core/number.h"
#include "core/text.h"

namespace farol::cli {

int runGuarded(const std::function<int()>& work, Report& report) {
    try {
        return work();
    } catch (const UsageError& error) {
        report.fail(error.diagnostic());
        return kUsage;
    } catch (const Error& error) {
        report.add(error.diagnostics());
        return error.code().rfind("option.", 0) == 0 ? kUsage : kInputFault;
    } catch (const OutputError& error) {
        report.fail(error.message());
        return kInternal;
    } catch (const std::exception& error) {
        report.fail(message<"internal/reason">("reason"_arg = uncut(error.what())));
        return kInternal;
    }
}

void addGlSource(CLI::App& command, render::GlSource& source) {
    const auto take = [&source](const std::string& word) {
        source = *render::kGlSourceWords.find(word);
    };
    const auto check = [](const std::string& word) {
        return render::kGlSourceWords.find(word)
                   ? std::string()
                   : word + " is none of " + joined(render::kGlSourceWords.all(), ", ");
    };
    command
        .add_option_function<std::string>(
            "--gl", take,
            "library that draws: OSMesa or EGL, by the processor, or EGL on a GPU; auto: OSMesa "
            "where it is installed, else EGL")
        ->check(check)
        ->type_name(joined(render::kGlSourceWords.all(), "|"))
        ->default_str("auto");
}

void addLanguage(CLI::App& command, Report& report) {
    const auto take = [&report](const std::string& word) {
        report.setLanguage(*kLanguageWords.find(word));
    };
    const auto check = [](const std::string& word) {
        return kLanguageWords.find(word)
                   ? std::string()
                   : word + " is none of " + joined(kLanguageWords.all(), ", ");
    };
    command
        .add_option_function<std::string>(
            "--lang", take, "language of diagnostics, findings and reports; default en")
        ->check(check)
        ->type_name(joined(kLanguageWords.all(), "|"));
}

void takesNumber(CLI::Option* option, double min, double max) {
    const auto text = [](double value) {
        std::ostringstream out;
        out.precision(10);
        out << value;
        return out.str();
    };
    const auto check = [=, range = text(min) + " to " + text(max)](const std::string& word) {
        const auto value = parseExact<double>(word);
        if (value && *value >= min && *value <= max) return std::string();
        return word + " is not a number in " + range;
    };
    option->check(check)->type_name(text(min) + ".." + text(max))->capture_default_str();
}

}  // namespace farol::cli
