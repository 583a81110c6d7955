#include "core/message.h"

#include <algorithm>

#include "core/error.h"
#include "core/number.h"
#include "core/text.h"

namespace farol {
namespace {

/// Cuts between UTF-8 characters; control characters become blanks.
std::string bounded(std::string_view text, std::size_t maxBytes) {
    std::size_t length = std::min(text.size(), maxBytes);
    const auto continues = [&text](std::size_t at) {
        return at < text.size() && (static_cast<unsigned char>(text[at]) & 0xC0U) == 0x80U;
    };
    while (length > 0 && continues(length)) --length;
    std::string result(text.substr(0, length));
    for (char& c : result)
        if (static_cast<unsigned char>(c) < 0x20U) c = ' ';
    return result + (length < text.size() ? "..." : "");
}

MessageArgument argument(std::string name, std::string text, std::string id = {}) {
    MessageArgument made;
    made.name = std::move(name);
    made.text = std::move(text);
    made.id = std::move(id);
    return made;
}

/// An argument that is a message, with that message's own arguments as "name.inner".
MessageArguments nested(std::string_view name, const std::string& text, const std::string& id,
                        const MessageArguments& arguments) {
    MessageArguments all{argument(std::string(name), bounded(text, kMaxArgumentBytes), id)};
    for (const MessageArgument& inner : arguments)
        all.push_back(argument(std::string(name) + "." + inner.name, inner.text, inner.id));
    return all;
}

/// Renders one text; the names of its arguments begin with `prefix`.
class TemplateRenderer {
  public:
    TemplateRenderer(const MessageArguments& arguments, const FindTemplate& find)
        : arguments_(arguments), find_(find) {}

    std::string render(std::string_view text, const std::string& prefix, int depth) const {
        std::string result;
        while (!text.empty()) {
            const std::size_t open = text.find('[');
            result += filled(text.substr(0, open), prefix, depth).text;
            if (open == std::string_view::npos) break;
            const std::size_t close = std::min(text.find(']', open), text.size() - 1);
            const Filled part = filled(text.substr(open + 1, close - open - 1), prefix, depth);
            if (!part.lacksValue) result += part.text;
            text.remove_prefix(close + 1);
        }
        return result;
    }

  private:
    struct Filled {
        std::string text;
        bool lacksValue = false;
    };

    Filled filled(std::string_view text, const std::string& prefix, int depth) const {
        Filled result;
        while (!text.empty()) {
            const std::size_t open = text.find('{');
            const std::size_t close = text.find('}', std::min(open, text.size()));
            result.text += text.substr(0, open);
            if (close == std::string_view::npos) break;
            const std::string value =
                valueOf(prefix + std::string(text.substr(open + 1, close - open - 1)), depth);
            result.lacksValue = result.lacksValue || value.empty();
            result.text += value;
            text.remove_prefix(close + 1);
        }
        return result;
    }

    std::string valueOf(const std::string& name, int depth) const {
        constexpr int kMaxDepth = 4;
        const auto at =
            std::find_if(arguments_.begin(), arguments_.end(),
                         [&](const MessageArgument& given) { return given.name == name; });
        if (at == arguments_.end()) return "";
        if (!at->id.empty() && find_ && depth < kMaxDepth)
            if (const auto text = find_(at->id)) return render(*text, name + ".", depth + 1);
        return at->text;
    }

    const MessageArguments& arguments_;
    const FindTemplate& find_;
};

}  // namespace

std::string renderTemplate(std::string_view text, const MessageArguments& arguments,
                           const FindTemplate& find) {
    return TemplateRenderer(arguments, find).render(text, "", 0);
}

MessageArguments sampleArguments(const MessageRow& row) {
    MessageArguments all;
    const auto names = placeholdersOf(row.text);
    for (std::size_t i = 0; i < names.size() && !names[i].empty(); ++i)
        all.push_back(argument(std::string(names[i]), std::string(row.samples[i])));
    return all;
}

namespace detail {

MessageArguments argumentOf(std::string_view name, std::string_view value) {
    return {argument(std::string(name), shown(value))};
}

MessageArguments argumentOf(std::string_view name, Uncut value) {
    return {argument(std::string(name), bounded(value.text, kMaxArgumentBytes))};
}

MessageArguments argumentOf(std::string_view name, double value) {
    return {argument(std::string(name), formatNumber(value))};
}

MessageArguments argumentOf(std::string_view name, const Message& value) {
    return nested(name, value.text, value.id, value.arguments);
}

MessageArguments argumentOf(std::string_view name, const Diagnostic& value) {
    return nested(name, value.message, value.id, value.arguments);
}

Message buildMessage(const MessageRow& row, std::initializer_list<MessageArguments> arguments) {
    Message message;
    message.id = row.id;
    for (const MessageArguments& group : arguments)
        for (const MessageArgument& given : group)
            if (message.arguments.size() < kMaxArguments) message.arguments.push_back(given);
    message.text = renderTemplate(row.text, message.arguments);
    return message;
}

}  // namespace detail
}  // namespace farol
