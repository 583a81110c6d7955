#pragma once

#include <cstddef>
#include <string>
#include <vector>

namespace farol::generator {
struct ShapeEntry;
}

namespace farol::scene {

/// A number of a shape's call. Where the scene does not write it, `value` is the default.
struct ShapeArgument {
    enum class Form { omitted, automatic, written };
    Form form = Form::omitted;
    double value = 0.0;
    bool operator==(const ShapeArgument&) const = default;
};

/// A shape with its arguments, parsed and checked once (generator::parseCall). Scenes hold it; only
/// the generator looks into the entry.
struct ShapeCall {
    const generator::ShapeEntry* entry = nullptr;  ///< a row of the generator's table
    std::string file;                      ///< the profile or patch file, where the shape takes one
    std::vector<ShapeArgument> arguments;  ///< as many as the entry has, in its order

    double length(std::size_t index) const { return arguments[index].value; }
    std::size_t count(std::size_t index) const {
        return static_cast<std::size_t>(arguments[index].value);
    }
    bool isWritten(std::size_t index) const {
        return arguments[index].form == ShapeArgument::Form::written;
    }
    bool operator==(const ShapeCall&) const = default;
};

}  // namespace farol::scene
