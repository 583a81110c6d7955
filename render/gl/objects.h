#pragma once

#include <utility>

#include "render/gl/api.h"

namespace farol::render::gl {

/// Owns one GL name; move-only; a moved-from object holds 0. `Delete` frees it through the table
/// that made it; the context must be current.
template <typename Traits>
class Object {
  public:
    Object() = default;
    explicit Object(const Api& api) : api_(&api), name_(Traits::create(api)) {}
    Object(const Api& api, GLuint name) : api_(&api), name_(name) {}
    ~Object() { reset(); }
    Object(Object&& other) noexcept
        : api_(std::exchange(other.api_, nullptr)), name_(std::exchange(other.name_, 0)) {}
    Object& operator=(Object&& other) noexcept {
        if (this != &other) {
            reset();
            api_ = std::exchange(other.api_, nullptr);
            name_ = std::exchange(other.name_, 0);
        }
        return *this;
    }
    Object(const Object&) = delete;
    Object& operator=(const Object&) = delete;

    GLuint name() const { return name_; }
    explicit operator bool() const { return name_ != 0; }

  private:
    void reset() {
        if (name_) Traits::destroy(*api_, name_);
        name_ = 0;
    }
    const Api* api_ = nullptr;
    GLuint name_ = 0;
};

#define FAROL_GL_OBJECT(Type, gen, del)                                         \
    struct Type##Traits {                                                       \
        static GLuint create(const Api& api) {                                  \
            GLuint name = 0;                                                    \
            api.gen(1, &name);                                                  \
            return name;                                                        \
        }                                                                       \
        static void destroy(const Api& api, GLuint name) { api.del(1, &name); } \
    };                                                                          \
    using Type = Object<Type##Traits>;

FAROL_GL_OBJECT(Buffer, GenBuffers, DeleteBuffers)
FAROL_GL_OBJECT(Texture, GenTextures, DeleteTextures)
FAROL_GL_OBJECT(VertexArray, GenVertexArrays, DeleteVertexArrays)
FAROL_GL_OBJECT(Framebuffer, GenFramebuffers, DeleteFramebuffers)
FAROL_GL_OBJECT(Query, GenQueries, DeleteQueries)
#undef FAROL_GL_OBJECT

struct ProgramTraits {
    static GLuint create(const Api& api) { return api.CreateProgram(); }
    static void destroy(const Api& api, GLuint name) { api.DeleteProgram(name); }
};
using Program = Object<ProgramTraits>;

}  // namespace farol::render::gl
