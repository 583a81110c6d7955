#pragma once

#include <functional>
#include <memory>

#include "render/gl/context.h"

namespace farol::support {

/// A real context that reports other facts.
class LesserContext final : public render::gl::Context {
  public:
    explicit LesserContext(const std::function<void(render::GlFacts&)>& change)
        : facts_(real_->facts()) {
        change(facts_);
    }
    void makeCurrent() override { real_->makeCurrent(); }
    const render::gl::Api& api() const override { return real_->api(); }
    const render::GlFacts& facts() const override { return facts_; }

  private:
    std::unique_ptr<render::gl::Context> real_ =
        render::gl::createContext(render::GlSource::automatic);
    render::GlFacts facts_;
};

}  // namespace farol::support
