#include <algorithm>
#include <glm/gtc/type_ptr.hpp>

#include "render/gl/painter_state.h"

namespace farol::render::gl {
namespace {

/// Of the 128 components of attributes; the others take up to 56.
constexpr int kMaxCarried = 72;

void setSurface(const Api& api, const DrawItem& item, const LinkedProgram& program) {
    const generator::Surface& surface = *item.surface;
    const glm::vec3 lengths(surface.lengths);
    const glm::vec2 form(surface.form);
    const glm::vec4 uv(surface.uv);
    api.Uniform3fv(program.unitFromObject, 1, glm::value_ptr(item.unitFromObject));
    api.Uniform3fv(program.surfaceLengths, 1, glm::value_ptr(lengths));
    api.Uniform2f(program.surfaceForm, form.x, form.y);
    api.Uniform4fv(program.surfaceUv, 1, glm::value_ptr(uv));
    const glm::vec4 discs(surface.discs);
    api.Uniform4fv(program.surfaceDiscs, 1, glm::value_ptr(discs));
    // A polar layout (uv.y < 0) is not scaled about its centre.
    api.Uniform1f(program.balance, uv.y > 0.0F ? item.unitFromObject.x * lengths.x : 1.0F);
    api.Uniform1f(program.seenFrom, item.inside ? -1.0F : 1.0F);
}

GLsizei countOf(const DrawItem& item) { return static_cast<GLsizei>(item.indices); }

/// Where the item's indices begin in their buffer.
const void* firstOf(const DrawItem& item) {
    return reinterpret_cast<const void*>(item.firstIndex * sizeof(std::uint32_t));
}

GLenum modeOf(Polygons polygons) {
    return polygons == Polygons::outlined   ? GL_LINE
           : polygons == Polygons::cornered ? GL_POINT
                                            : GL_FILL;
}

/// What the fragments of a program with Feature::carried read of its lights (common.glsl).
int numbersOf(const ProgramKey& key) {
    const auto count = [&](Feature feature, int numbers) {
        return key.features.has(feature) ? numbers : 0;
    };
    return key.count * (9 + count(Feature::positional, 4) + count(Feature::spot, 5) +
                        count(Feature::specular, 3));
}

}  // namespace

const EyeShadowLight& shadowLightOf(const FramePlan& plan, const EyeLight& light) {
    return plan.shadowLights[static_cast<std::size_t>(light.ambient.w)];
}

ProgramKey keyOf(const FramePlan& plan, const Pass& pass, const Batch& batch) {
    const DrawItem& first = plan.items[plan.batches.order[batch.first]];
    ProgramKey key;
    key.features = pass.features | (batch.features & pass.itemFeatures);
    if (batch.instanced) key.features.add(Feature::instanced);
    if (!key.features.has(Feature::textured)) key.features.remove(Feature::supersampled);
    if (!key.features.hasAny({Feature::alphaTest, Feature::peeled}))
        key.features.remove(Feature::eachSample);
    if (key.features.has(Feature::eachSample)) key.samples = pass.target.samples;
    if (key.features.has(Feature::surface))
        key.surfaceKind = plan.items[plan.batches.order[batch.first]].surface->kind->glsl;
    const auto set = static_cast<std::size_t>(first.lightSet);
    if (pass.features.hasAny(kLitFeatures))
        key.count = static_cast<int>(plan.lightSets[set].size());
    if (key.count == 0 || numbersOf(key) > kMaxCarried) key.features.remove(Feature::carried);
    if (!key.features.has(Feature::shadowed)) return key;
    for (const EyeLight& light : plan.lightSets[set]) {
        if (!(light.diffuse.w > 0.0F)) break;
        ++key.shadows;
        if (light.diffuse.w == kCascadeShadow) ++key.shadowCascades;
        if (light.diffuse.w == kCubeShadow) ++key.shadowCubes;
    }
    if (key.shadows == 0) key.features.remove(Feature::shadowed);
    if (key.shadowCascades > 0) key.features.add(Feature::shadowCascade);
    if (key.shadowCubes > 0) key.features.add(Feature::shadowCube);
    return key;
}

void Painter::State::setLights(const DrawItem& item, int count, const LinkedProgram& program) {
    if (count == 0) return;
    const auto set = static_cast<std::size_t>(item.lightSet);
    api.BindBufferBase(GL_UNIFORM_BUFFER, kLightsBinding, lightBuffers[set].name());
    if (set < shadowBuffers.size())
        api.BindBufferBase(GL_UNIFORM_BUFFER, kShadowLightsBinding, shadowBuffers[set].name());
    if (program.lightCount >= 0) api.Uniform1i(program.lightCount, count);
}

/// Moves the next draws behind others in their plane, by `rank` steps. A step is the most that
/// vertex snapping along an axis, of either draw, and rounding change the depth. `depthOnly`: also
/// behind their own depths, by more than rounding of the plane's equation changes those: four times
/// 2^-24 of its value and of its change over the target.
void Painter::State::setDepthRank(int rank, bool depthOnly) {
    if (rank == 0 && !depthOnly) return api.Disable(GL_POLYGON_OFFSET_FILL);
    const auto steps = static_cast<float>(-rank);  // smaller is farther
    const float behind = depthOnly ? 1.0F : 0.0F;
    api.Enable(GL_POLYGON_OFFSET_FILL);
    api.PolygonOffset(steps * static_cast<float>(4.0 * facts.snapPx) - behind / 64.0F,
                      (steps - behind) * 16.0F);
}

void Painter::State::setScale(const Pass& pass, const LinkedProgram& program) {
    if (program.samplesAcross >= 0)
        api.Uniform1f(program.samplesAcross, static_cast<float>(pass.target.scale));
}

/// Places of the GL's samples, where the program tests them.
void Painter::State::setSamples(const Pass& pass, const LinkedProgram& program) {
    if (program.samplePlaces < 0) return;
    const auto pattern = std::find_if(
        facts.samplePatterns.begin(), facts.samplePatterns.end(), [&](const SamplePattern& one) {
            return one.size() == static_cast<std::size_t>(pass.target.samples);
        });
    if (pattern == facts.samplePatterns.end()) return;
    std::vector<glm::vec2> places;
    for (const glm::dvec2& place : *pattern) places.emplace_back(place - 0.5);
    api.Uniform2fv(program.samplePlaces, static_cast<GLsizei>(places.size()),
                   glm::value_ptr(places.front()));
}

void Painter::State::setMaterial(const FramePlan& plan, const DrawItem& item,
                                 const LinkedProgram& program) {
    const glm::vec3 base = item.emissive + item.ambient * plan.globalAmbient;
    api.Uniform3fv(program.materialDiffuse, 1, glm::value_ptr(item.diffuse));
    api.Uniform3fv(program.materialBase, 1, glm::value_ptr(base));
    api.Uniform3fv(program.materialAmbient, 1, glm::value_ptr(item.ambient));
    api.Uniform3fv(program.materialSpecular, 1, glm::value_ptr(item.specular));
    api.Uniform1f(program.materialShininess, item.shininess);
    if (program.opacity >= 0) api.Uniform1f(program.opacity, item.opacity);
    if (program.shadowOffset >= 0)
        api.Uniform3fv(program.shadowOffset, 1, glm::value_ptr(item.shadowOffset));
    if (program.uvFrom >= 0) api.Uniform4fv(program.uvFrom, 1, glm::value_ptr(item.uvFrom));
    if (program.mappedFrom >= 0) {
        const glm::vec3 origin(item.mesh->mesh.origin());
        api.Uniform3fv(program.mappedFrom, 1, glm::value_ptr(origin));
    }
    if (program.planeS >= 0) {
        api.Uniform4fv(program.planeS, 1, glm::value_ptr(item.planeS));
        api.Uniform4fv(program.planeT, 1, glm::value_ptr(item.planeT));
    }
}

/// A model whose batch is set up.
void Painter::State::drawOne(const DrawItem& item, const GpuMesh& mesh,
                             const LinkedProgram& program) {
    api.UniformMatrix4fv(program.viewFromObject, 1, GL_FALSE, glm::value_ptr(item.viewFromObject));
    if (program.normalFromObject >= 0)
        api.UniformMatrix3fv(program.normalFromObject, 1, GL_FALSE,
                             glm::value_ptr(item.normalFromObject));
    if (item.surface) api.Uniform3fv(program.unitEye, 1, glm::value_ptr(item.surfaceEye));
    if (mesh.indexed)
        api.DrawElements(GL_TRIANGLES, countOf(item), GL_UNSIGNED_INT, firstOf(item));
    else
        api.DrawArrays(GL_TRIANGLES, static_cast<GLint>(item.firstIndex), countOf(item));
}

void Painter::State::drawModels(const FramePlan& plan, const Pass& pass, const PassItem& models,
                                int& drawCalls) {
    const glm::mat4 clip(pass.clip);
    const glm::mat3 worldFromView(glm::transpose(plan.view.rotation));
    const bool flat = pass.features.has(Feature::flat);
    api.PolygonMode(GL_FRONT_AND_BACK, modeOf(pass.state.polygons));
    const LinkedProgram* current = nullptr;
    GLuint base = 0;  // of the batch's places
    for (std::size_t b = 0; b < models.first + models.count; ++b) {
        const Batch& batch = plan.batches.batches[b];
        const GLuint places = base;
        if (batch.instanced) base += static_cast<GLuint>(batch.count);
        if (b < models.first) continue;
        const DrawItem& first = plan.items[plan.batches.order[batch.first]];
        const ProgramKey key = keyOf(plan, pass, batch);
        const LinkedProgram& program = programs.get(key);
        if (&program != current) {
            current = &program;
            api.UseProgram(program.program.name());
            api.UniformMatrix4fv(program.clipFromView, 1, GL_FALSE, glm::value_ptr(clip));
            if (program.worldFromView >= 0)
                api.UniformMatrix3fv(program.worldFromView, 1, GL_FALSE,
                                     glm::value_ptr(worldFromView));
            if (program.nearest >= 0)
                api.Uniform1f(program.nearest, static_cast<float>(plan.view.near));
            setScale(pass, program);
            setSamples(pass, program);
        }
        if (key.features.has(Feature::surface)) setSurface(api, first, program);
        api.Uniform3fv(program.plainColor, 1, glm::value_ptr(batch.plainColor));
        setMaterial(plan, first, program);
        setLights(first, key.count, program);
        if (first.texture >= 0)
            api.BindTexture(GL_TEXTURE_2D, textureNames[static_cast<std::size_t>(first.texture)]);
        api.FrontFace(first.mirrored ? GL_CW : GL_CCW);
        setDepthRank(first.depthRank, pass.state.depthOnly);
        const GpuMesh& mesh = meshes.get(*first.mesh, flat);
        api.BindVertexArray(mesh.array.name());
        if (batch.instanced) {
            const auto count = static_cast<GLsizei>(batch.count);
            if (mesh.indexed)
                api.DrawElementsInstancedBaseInstance(GL_TRIANGLES, countOf(first), GL_UNSIGNED_INT,
                                                      firstOf(first), count, places);
            else
                api.DrawArraysInstancedBaseInstance(GL_TRIANGLES,
                                                    static_cast<GLint>(first.firstIndex),
                                                    countOf(first), count, places);
            ++drawCalls;
            continue;
        }
        for (std::size_t i = batch.first; i < batch.first + batch.count; ++i, ++drawCalls)
            drawOne(plan.items[plan.batches.order[i]], mesh, program);
    }
    setDepthRank(0, false);
    api.FrontFace(GL_CCW);
    api.PolygonMode(GL_FRONT_AND_BACK, GL_FILL);
}

/// See-through models over what is drawn, in the order of their batches.
void Painter::State::drawBlended(const FramePlan& plan, const Pass& pass, const PassItem& models,
                                 int& drawCalls) {
    api.Enable(GL_BLEND);
    api.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);  // colours are premultiplied
    api.DepthMask(GL_FALSE);
    drawModels(plan, pass, models, drawCalls);
    api.DepthMask(GL_TRUE);
    api.Disable(GL_BLEND);
}

/// See-through models over what is drawn, layer by layer.
void Painter::State::drawPeeled(const FramePlan& plan, const Pass& pass, const PassItem& models,
                                int& drawCalls) {
    if (!peeler) peeler.emplace(api, target->format(), facts.packInvert);
    const glm::ivec4 viewport = viewportOf(plan, pass);
    peeler->begin(viewport);
    int layers = 0;
    for (bool any = true; any; ++layers) {
        peeler->beginLayer(layers, *target, viewport);
        drawModels(plan, pass, models, drawCalls);
        any = peeler->endLayer();
        if (!any) break;
        if (layers == kMaxPeeledLayers) {
            leftLayersOut = true;
            break;
        }
        // Under the layers before.
        peeler->sum().bind(viewport);
        api.BlendFunc(GL_ONE_MINUS_DST_ALPHA, GL_ONE);
        drawLayer(peeler->layer(layers));
    }
    peeledLayers = std::max(peeledLayers, layers);
    target->bind(viewport);
    api.BlendFunc(GL_ONE, GL_ONE_MINUS_SRC_ALPHA);
    drawLayer(peeler->sum());
}

/// Blends a target of the same format over the bound one.
void Painter::State::drawLayer(const Target& layer) {
    ProgramKey key{Shaders::window, {Feature::layer}};
    if (layer.format().samples > 1) {
        key.features.add(Feature::eachSample);
        key.samples = layer.format().samples;
    }
    api.UseProgram(programs.get(key).program.name());
    api.BindTexture(layer.textureKind(), layer.color());
    api.BindVertexArray(emptyArray.name());
    api.Disable(GL_DEPTH_TEST);
    api.Enable(GL_BLEND);
    api.DrawArrays(GL_TRIANGLES, 0, 3);
    api.Disable(GL_BLEND);
    api.Enable(GL_DEPTH_TEST);
}

void Painter::State::drawLines(const FramePlan& plan, const Pass& pass, const PassItem& lines,
                               int& drawCalls) {
    const glm::mat4 clip(pass.clip);
    const LinkedProgram& program = programs.get({Shaders::line, {}, 0});
    api.UseProgram(program.program.name());
    api.UniformMatrix4fv(program.clipFromView, 1, GL_FALSE, glm::value_ptr(clip));
    api.BindVertexArray(lineArray.name());
    api.BindBuffer(GL_ARRAY_BUFFER, lineBuffer.name());
    api.BufferData(GL_ARRAY_BUFFER, static_cast<GLsizeiptr>(lines.count * sizeof(LineVertex)),
                   &plan.lines[lines.first], GL_STREAM_DRAW);
    for (const GLuint location : {0U, 1U}) {
        api.EnableVertexAttribArray(location);
        api.VertexAttribPointer(location, 3, GL_FLOAT, GL_FALSE, sizeof(LineVertex),
                                reinterpret_cast<const void*>(location * sizeof(glm::vec3)));
    }
    api.DrawArrays(GL_LINES, 0, static_cast<GLsizei>(lines.count));
    ++drawCalls;
}

/// Where nothing is drawn yet: the depth is still that of the clear, which nothing that is drawn
/// has.
void Painter::State::drawBackdrop(const FramePlan& plan, const Pass& pass, const PassItem& backdrop,
                                  int& drawCalls) {
    FeatureSet features = pass.features & FeatureSet{Feature::supersampled};
    const GLuint texture = textureNames[static_cast<std::size_t>(backdrop.texture)];
    api.BindVertexArray(emptyArray.name());
    api.DepthFunc(GL_EQUAL);
    api.DepthMask(GL_FALSE);
    if (backdrop.kind == PassItem::Kind::skybox) {
        features.add(Feature::skybox);
        const LinkedProgram& program = programs.get({Shaders::window, features, 0});
        const glm::mat3 worldFromView(glm::transpose(plan.view.rotation));
        const glm::vec2 tangents(plan.view.tanHalfFov);
        api.UseProgram(program.program.name());
        api.UniformMatrix3fv(program.worldFromView, 1, GL_FALSE, glm::value_ptr(worldFromView));
        api.Uniform2f(program.tangents, tangents.x, tangents.y);
        setScale(pass, program);
        api.BindTexture(GL_TEXTURE_CUBE_MAP, texture);
    } else {
        const LinkedProgram& program = programs.get({Shaders::window, features, 0});
        api.UseProgram(program.program.name());
        setScale(pass, program);
        api.BindTexture(GL_TEXTURE_2D, texture);
    }
    api.DrawArrays(GL_TRIANGLES, 0, 3);
    ++drawCalls;
    api.DepthMask(GL_TRUE);
    api.DepthFunc(GL_GREATER);
}

}  // namespace farol::render::gl
