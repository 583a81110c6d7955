#include "interchange/adapt.h"
#include "interchange/write.h"
#include "render/prepare.h"

namespace farol::interchange {

WrittenScene writeXml(const render::Job& job, scene::Form form) {
    render::Prepared prepared = render::prepare(job);
    WrittenScene model;
    const scene::Scene adapted = adapt(prepared.scene, form, prepared.diagnostics);
    model.bytes = scene::write(adapted, form);
    model.diagnostics = std::move(prepared.diagnostics);
    return model;
}

}  // namespace farol::interchange
