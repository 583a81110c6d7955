#include <algorithm>
#include <array>

#include "generator/io/formats.h"
#include "generator/io/gathered.h"
#include "generator/messages.h"

/// Files that name their numbers: "v: 0 1 2", "VERTICES:" before its rows, JSON, XML.
namespace farol::generator::io {
namespace {

bool isLetterOf(char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z') || c == '_'; }

bool isLetterOrDigit(char c) { return isLetterOf(c) || (c >= '0' && c <= '9'); }

bool isBetween(char c) {
    return isSeparator(c) || c == ':' || c == '=' || c == '"' || c == '\'' || c == '<' || c == '>';
}

/// Reads a text of words and numbers; any other token is an error.
class LabelReader {
  public:
    LabelReader(std::string_view text, const std::string& file)
        : text_(text), file_(file), gathered_(file) {}

    RawMesh read() {
        while (!text_.empty()) {
            ++line_;
            const std::size_t end = std::min(text_.find('\n'), text_.size());
            readLine(text_.substr(0, end));
            text_.remove_prefix(std::min(end + 1, text_.size()));
        }
        flush(false);
        return gathered_.take();
    }

  private:
    void readLine(std::string_view line) {
        line = line.substr(0, commentStart(line));
        bool unknown = false;  // a word of this line has no role: "Length: 2"
        bool words = false;
        std::size_t numbers = 0;
        component_ = Role::none;
        for (std::size_t at = 0; at < line.size();) {
            if (isBetween(line[at])) {
                ++at;
                continue;
            }
            const std::size_t end = endOf(line, at);
            const std::string_view token = line.substr(at, end - at);
            const Location where{file_, line_, static_cast<int>(at) + 1};
            at = end;
            if (const auto number = numberOf(token, where)) {
                ++numbers;
                if (component_ != Role::none)
                    addComponent(*number);
                else
                    run_.push_back(*number);
                continue;
            }
            if (std::none_of(token.begin(), token.end(), isLetterOrDigit))
                continue;  // a rule: ----
            if (!isLetterOf(token[0]))
                throw Error(message<"mesh.syntax/number">("value"_arg = printable(token)), where);
            words = true;
            const Role role = roleOf(token);
            // The second of a pair u, v.
            const bool pair = component_ == Role::uvs && token.size() == 1 &&
                              (token[0] == 'v' || token[0] == 't');
            if (role == Role::component || pair) {
                flush(unknown);
                component_ = componentOf(pair ? "u" : token, role_);
                continue;
            }
            flush(unknown);
            component_ = Role::none;
            unknown = role == Role::none;
            if (!unknown) role_ = role;
        }
        // A column of numbers is one list: it goes on in the next line.
        if (words || numbers != 1 || run_.size() != columns_ + 1) {
            flush(unknown);
        } else {
            ++columns_;
        }
    }

    /// One of the numbers of a vertex that are named one by one.
    void addComponent(double value) {
        std::vector<double>& loose = loose_[static_cast<std::size_t>(component_)];
        loose.push_back(value);
        if (loose.size() < (component_ == Role::uvs ? 2U : 3U)) return;
        gathered_.add(component_, loose, line_);
        loose.clear();
    }

    static std::string printable(std::string_view token);

    /// Returns the end of the token at `at`. A word ends at a separator only, not at a digit.
    static std::size_t endOf(std::string_view line, std::size_t at) {
        if (!isLetterOf(line[at])) {
            std::size_t end = tokenEnd(line, at);
            for (std::size_t k = at; k < end; ++k)
                if (isBetween(line[k]) && line[k] != '(' && line[k] != ')') return k;
            return end;
        }
        std::size_t end = at;
        while (end < line.size() && !isBetween(line[end])) ++end;
        // "nan(ind)" begins with a letter, too.
        const bool nan = end - at == 3 && end < line.size() && line[end] == '(';
        return nan ? tokenEnd(line, at) : end;
    }

    /// Ends a run of numbers; drops one after an unknown word.
    void flush(bool unknown) {
        columns_ = 0;
        gathered_.add(unknown ? Role::none : role_, run_, line_);
        run_.clear();
    }

    std::string_view text_;
    const std::string& file_;
    Gathered gathered_;
    int line_ = 0;
    Role role_ = Role::none;
    std::vector<double> run_;      ///< numbers of one role in this line, or in a column
    std::size_t columns_ = 0;      ///< number of them from earlier lines
    Role component_ = Role::none;  ///< of a number that is named alone: "x: 1"
    std::array<std::vector<double>, 6> loose_;  ///< by role: of a vertex that is not complete
};

std::string LabelReader::printable(std::string_view token) {
    std::string shown(token.substr(0, 24));
    std::replace_if(
        shown.begin(), shown.end(),
        [](char c) { return static_cast<unsigned char>(c - 0x20) > 0x5E; }, '?');
    return shown;
}

/// Elements with numbers as attributes or text: <Vertex x="0" y="1" z="2"/>, <face>0 1 2</face>.
class ElementReader {
  public:
    ElementReader(std::string_view text, const std::string& file)
        : text_(text), file_(file), gathered_(file) {}

    RawMesh read() {
        while (at_ < text_.size()) {
            if (text_[at_] == '<')
                readTag();
            else
                readText();
        }
        return gathered_.take();
    }

  private:
    static constexpr std::size_t kMaxDepth = 64;

    void readTag() {
        if (text_.compare(at_, 4, "<!--") == 0) return skipTo("-->");
        const std::size_t begin = at_ + 1;
        std::size_t end = begin;  // of the tag: not inside of quotes
        for (char quote = 0; end < text_.size() && (quote != 0 || text_[end] != '>'); ++end) {
            if (quote != 0 && text_[end] == quote)
                quote = 0;
            else if (quote == 0 && (text_[end] == '"' || text_[end] == '\''))
                quote = text_[end];
        }
        std::string_view tag = text_.substr(begin, end - begin);
        if (!tag.empty() && tag[0] == '/') {
            if (!roles_.empty()) roles_.pop_back();
        } else if (!tag.empty() && isLetterOf(tag[0])) {
            open(tag);
        }
        advance(std::min(end + 1, text_.size()));
    }

    void open(std::string_view tag) {
        std::size_t end = 0;
        while (end < tag.size() && !isBetween(tag[end]) && tag[end] != '/' && tag[end] != '\n')
            ++end;
        const Role own = roleOf(tag.substr(0, end));
        const Role above = roles_.empty() ? Role::none : roles_.back();
        const Role role = own == Role::none || own == Role::component ? above : own;
        readAttributes(tag.substr(end), role);
        const bool closed = tag.back() == '/';
        if (!closed && roles_.size() < kMaxDepth) roles_.push_back(role);
    }

    /// Reads name, =, value in quotes; ignores values that are no numbers.
    void readAttributes(std::string_view rest, Role role) {
        std::vector<double> places, normals, uvs, corners;
        while (true) {
            const std::size_t equals = rest.find('=');
            if (equals == std::string_view::npos) break;
            std::string_view name = rest.substr(0, equals);
            while (!name.empty() && isSpace(name.back())) name.remove_suffix(1);
            const std::size_t start = name.find_last_of(" \t\r\n/");
            if (start != std::string_view::npos) name.remove_prefix(start + 1);
            std::size_t begin = equals + 1;
            while (begin < rest.size() && isSpace(rest[begin])) ++begin;
            if (begin == rest.size()) break;
            // Without quotes a value ends at a blank.
            const bool isQuoted = rest[begin] == '"' || rest[begin] == '\'';
            const std::size_t close =
                isQuoted ? rest.find(rest[begin], begin + 1)
                         : std::min(rest.find_first_of(" \t\r\n/", begin), rest.size());
            if (close == std::string_view::npos) break;
            if (isQuoted) ++begin;
            const std::vector<double> values = numbersOf(rest.substr(begin, close - begin));
            rest.remove_prefix(std::min(close + 1, rest.size()));
            if (values.empty()) continue;
            const std::string lower = lowerCase(name.substr(0, 24));
            if (values.size() > 1 && roleOf(lower) != Role::component) {
                const Role named = roleOf(lower);
                gathered_.add(named == Role::none ? role : named, values, line_);
                continue;
            }
            sort(lower, role, values[0], places, normals, uvs, corners);
        }
        if (places.size() >= 3)
            gathered_.add(role == Role::normals ? Role::normals : Role::positions, places, line_);
        else if (places.size() == 2 && role == Role::uvs)
            gathered_.add(Role::uvs, places, line_);
        gathered_.add(Role::normals, normals, line_);
        gathered_.add(Role::uvs, uvs, line_);
        if (corners.size() == 3) gathered_.add(Role::indices, corners, line_);
    }

    /// One attribute with one number, by its name.
    static void sort(const std::string& name, Role role, double value, std::vector<double>& places,
                     std::vector<double>& normals, std::vector<double>& uvs,
                     std::vector<double>& corners) {
        const auto is = [&name](std::initializer_list<const char*> names) {
            return std::find(names.begin(), names.end(), name) != names.end();
        };
        if (role == Role::indices) {
            if (is({"a",  "b",  "c",  "v0", "v1", "v2", "v3", "p0", "p1", "p2", "p3",
                    "i0", "i1", "i2", "i3", "i",  "j",  "k",  "x",  "y",  "z"}))
                corners.push_back(value);
        } else if (is({"x", "y", "z", "posx", "posy", "posz", "px", "py", "pz", "vx", "vy",
                       "vz"})) {
            places.push_back(value);
        } else if (is({"nx", "ny", "nz", "normx", "normy", "normz", "normalx", "normaly",
                       "normalz"})) {
            normals.push_back(value);
        } else if (is({"u", "v", "s", "t", "tx", "ty", "texx", "texy"})) {
            uvs.push_back(value);
        }
    }

    void readText() {
        const std::size_t end = std::min(text_.find('<', at_), text_.size());
        const std::vector<double> values = numbersOf(text_.substr(at_, end - at_));
        const Role role = roles_.empty() ? Role::none : roles_.back();
        // <x>1</x> <y>2</y> <z>3</z>: one number an element.
        if (values.size() == 1 && role == Role::positions) {
            loose_.push_back(values[0]);
            if (loose_.size() == 3) {
                gathered_.add(role, loose_, line_);
                loose_.clear();
            }
        } else {
            gathered_.add(role, values, line_);
        }
        advance(end);
    }

    static bool isSpace(char c) { return c == ' ' || c == '\t' || c == '\r' || c == '\n'; }

    /// All numbers of a text, or none where it holds anything else.
    std::vector<double> numbersOf(std::string_view text) const {
        std::vector<double> out;
        for (std::size_t at = 0; at < text.size();) {
            if (isSeparator(text[at]) || text[at] == '\n') {
                ++at;
                continue;
            }
            std::size_t end = tokenEnd(text, at);
            end = std::min(end, std::max(text.find('\n', at), at));
            const auto number = numberOf(text.substr(at, end - at), {file_, line_, 0});
            if (!number) return {};
            out.push_back(*number);
            at = end;
        }
        return out;
    }

    void skipTo(std::string_view end) {
        const std::size_t found = text_.find(end, at_);
        advance(found == std::string_view::npos ? text_.size() : found + end.size());
    }

    void advance(std::size_t to) {
        const std::string_view passed = text_.substr(at_, to - at_);
        line_ += static_cast<int>(std::count(passed.begin(), passed.end(), '\n'));
        at_ = to;
    }

    std::string_view text_;
    const std::string& file_;
    Gathered gathered_;
    std::size_t at_ = 0;
    int line_ = 1;
    std::vector<Role> roles_;    ///< of the elements that are open
    std::vector<double> loose_;  ///< coordinates of a place that is not complete
};

}  // namespace

bool looksLikeElements(std::string_view bytes) {
    const std::size_t first = bytes.find_first_not_of(" \t\r\n");
    if (first == std::string_view::npos || first + 1 >= bytes.size() || bytes[first] != '<')
        return false;
    const char next = bytes[first + 1];  // "<0, 1, 2>" is a place
    return isLetterOf(next) || next == '!' || next == '?';
}

RawMesh decodeElements(std::string_view bytes, const std::string& fileName) {
    return ElementReader(bytes, fileName).read();
}

bool looksLabelled(std::string_view bytes) {
    // A word for positions within the first lines.
    constexpr std::size_t kLooked = 8192;  // bytes
    const std::string_view text = bytes.substr(0, kLooked);
    for (std::size_t at = 0; at < text.size();) {
        if (!isLetterOf(text[at])) {
            ++at;
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && isLetterOf(text[end])) ++end;
        // 1e5, 2f; "nx,ny,nz,u,v" heads columns.
        const bool number = at > 0 && (isLetterOrDigit(text[at - 1]) || text[at - 1] == ',');
        const std::string_view word = text.substr(at, end - at);
        at = end;
        if (number) continue;
        const Role role = roleOf(word);
        if (role == Role::positions || role == Role::indices) return true;
        // "x: 1", "x" = 1; not a head of columns.
        const std::size_t next = text.find_first_not_of("\"' ", end);
        if (role == Role::component && next != std::string_view::npos &&
            (text[next] == ':' || text[next] == '='))
            return true;
    }
    return false;
}

RawMesh decodeLabelled(std::string_view bytes, const std::string& fileName) {
    return LabelReader(bytes, fileName).read();
}

}  // namespace farol::generator::io
