#include <algorithm>
#include <map>

#include "generator/io/writer.h"
#include "interchange/messages.h"
#include "interchange/placement.h"
#include "interchange/subject.h"
#include "interchange/write.h"
#include "scene/animation.h"

namespace farol::interchange {
namespace {

/// OBJ and MTL hold no blanks in names.
std::string wordOf(std::string name) {
    for (char& c : name)
        if (static_cast<unsigned char>(c) <= ' ' || c == '\\') c = '_';
    return name;
}

glm::vec3 inUnit(const glm::vec3& color) { return glm::clamp(color, 0.0F, 1.0F); }

class ObjWriter {
  public:
    ObjWriter(const render::Job& job, std::string stem, std::size_t maxBytes)
        : subject_(job), stem_(wordOf(std::move(stem))), maxBytes_(maxBytes) {}

    WrittenScene write() {
        out_.text("mtllib " + stem_ + ".mtl\n");
        for (const render::Instance& instance : subject_.placed().instances) add(instance);
        noteLosses();
        written_.bytes = obj_ + out_.take();
        written_.beside.insert(written_.beside.begin(), {stem_ + ".mtl", library_.take()});
        written_.materials = static_cast<std::int64_t>(materials_.size());
        written_.textures = static_cast<std::int64_t>(images_.size());
        written_.diagnostics = std::move(subject_.findings());
        return std::move(written_);
    }

  private:
    void add(const render::Instance& instance) {
        const scene::Model& model = *instance.model;
        const std::shared_ptr<const render::MeshData> data = subject_.meshOf(model);
        if (data->mesh.indices().empty()) return;
        ++written_.nodes;
        written_.triangles += static_cast<std::int64_t>(data->mesh.triangles());
        const std::string& name = !model.name.empty()  ? model.name
                                  : !model.id.empty()  ? model.id
                                  : model.file.empty() ? model.command
                                                       : model.file;
        out_.text("o " + wordOf(name) + "-" + std::to_string(written_.nodes) + "\n");
        // The matrix has the origin of the mesh in it.
        for (const Look& look : subject_.looksOf(model, *data, subject_.scene()))
            addPart(*data, look, instance.worldFromObject);
    }

    /// Each part has the vertices of its whole mesh only if it is the only one.
    void addPart(const render::MeshData& data, const Look& look,
                 const glm::dmat4& worldFromObject) {
        const MappedMesh mesh = mapped(data.mesh, look.texture);
        std::vector<std::uint32_t> numberOf(mesh.positions.size(), 0);
        std::vector<std::uint32_t> used;
        for (std::size_t i = look.first; i < look.first + look.count; ++i)
            if (std::uint32_t& number = numberOf[mesh.indices[i]]; number == 0) {
                used.push_back(mesh.indices[i]);
                number = static_cast<std::uint32_t>(used.size());
            }
        const glm::dmat3 linear(worldFromObject);
        const glm::dmat3 cofactor(glm::cross(linear[1], linear[2]),
                                  glm::cross(linear[2], linear[0]),
                                  glm::cross(linear[0], linear[1]));
        const double det = glm::dot(linear[0], cofactor[0]);
        for (const std::uint32_t index : used) {
            const glm::vec3 p(worldFromObject * glm::dvec4(glm::dvec3(mesh.positions[index]), 1.0));
            if (!(glm::length(glm::dvec3(p)) <= kMaxFloat))
                throw Error(message<"limit.model/size">("max"_arg = kMaxFloat));
            if (look.isColored && !mesh.colors.empty()) {
                const glm::vec3 c = glm::vec3(mesh.colors[index]) / 255.0F;
                out_.row({p.x, p.y, p.z, c.r, c.g, c.b}, "v");
            } else {
                out_.row({p.x, p.y, p.z}, "v");
            }
        }
        for (const std::uint32_t index : used)
            if (!mesh.uvs.empty()) out_.row({mesh.uvs[index].x, mesh.uvs[index].y}, "vt");
        for (const std::uint32_t index : used) {
            if (mesh.normals.empty()) break;
            const glm::dvec3 n =
                (det < 0.0 ? -1.0 : 1.0) * cofactor * glm::dvec3(mesh.normals[index]);
            const double length = glm::length(n);
            const glm::vec3 unit(length > 0.0 ? n / length : glm::dvec3(0.0, 1.0, 0.0));
            out_.row({unit.x, unit.y, unit.z}, "vn");
        }
        out_.text("usemtl " + materialOf(look) + "\n");
        for (std::size_t i = look.first; i + 2 < look.first + look.count; i += 3) {
            out_.text("f");
            for (std::size_t k = 0; k < 3; ++k) {
                // A mirrored triangle turns round.
                const std::size_t corner = i + (det < 0.0 ? 2 - k : k);
                addCorner(numberOf[mesh.indices[corner]], !mesh.uvs.empty(), !mesh.normals.empty());
            }
            out_.text("\n");
        }
        vertices_ += used.size();
        if (!mesh.uvs.empty()) uvs_ += used.size();
        if (!mesh.normals.empty()) normals_ += used.size();
        obj_ += out_.take();
        out_ = {};
        checkSize();
    }

    void addCorner(std::uint32_t number, bool hasUv, bool hasNormal) {
        out_.text(" ");
        out_.number(vertices_ + number);
        if (hasUv || hasNormal) out_.text("/");
        if (hasUv) out_.number(uvs_ + number);
        if (!hasNormal) return;
        out_.text("/");
        out_.number(normals_ + number);
    }

    std::string materialOf(const Look& look) {
        generator::io::Writer lines;
        const PhongColors& colors = look.colors;
        const auto color = [&](const char* keyword, const glm::vec3& value) {
            const glm::vec3 in = inUnit(value);
            lines.row({in.r, in.g, in.b}, keyword);
        };
        color("Kd", colors.diffuse);
        if (look.opacity < 1.0F) lines.row({look.opacity}, "d");
        if (subject_.isLit()) {
            color("Ka", glm::vec3(0.0F));
            color("Ke", colors.base);
            color("Ks", colors.specular);
            lines.row({colors.shininess}, "Ns");
        }
        lines.text(!subject_.isLit()                    ? "illum 0\n"
                   : colors.specular == glm::vec3(0.0F) ? "illum 1\n"
                                                        : "illum 2\n");
        if (look.texture != nullptr)
            lines.text(std::string("map_Kd ") + (look.texture->clamp ? "-clamp on " : "") +
                       imageName(*look.texture) + "\n");
        const std::string text = lines.take();
        const auto [at, isNew] = materials_.emplace(text, "");
        if (isNew) {
            at->second = "material-" + std::to_string(materials_.size());
            library_.text("newmtl " + at->second + "\n" + text);
        }
        return at->second;
    }

    std::string imageName(const scene::Texture& texture) {
        const auto [at, isNew] = images_.emplace(render::refOf(texture, subject_.assets()).key, "");
        if (isNew) {
            PortableImage image = imageOf(texture, subject_.assets());
            at->second = stem_ + "-" + std::to_string(written_.beside.size()) + "." +
                         std::string(image.ending);
            besideBytes_ += image.bytes.size();
            written_.beside.push_back({at->second, std::move(image.bytes)});
        }
        return at->second;
    }

    void checkSize() const {
        if (obj_.size() + besideBytes_ > maxBytes_)
            throw Error(message<"limit.model/bytes">("max"_arg = maxBytes_ >> 20U));
    }

    void leaveOut(Message feature, const Location& where) {
        subject_.findings().push_back(diagnosticOf(
            Severity::warning,
            message<"convert.left-out">("format"_arg = "OBJ", "feature"_arg = feature), where));
    }

    void noteLosses() {
        const scene::Scene& scene = subject_.scene();
        if (scene.camera) leaveOut(message<"part.feature-camera">(), scene.camera->where);
        if (!subject_.placed().lights.empty())
            leaveOut(message<"part.feature-lights">(),
                     subject_.placed().lights.front().light->where);
        if (scene::isAnimated(scene))
            subject_.findings().push_back(diagnosticOf(
                Severity::warning,
                message<"convert.approximated">(
                    "format"_arg = "OBJ", "feature"_arg = message<"part.feature-animation">(),
                    "instead"_arg = message<"part.instead-first-moment">()),
                scene.where));
        if (scene.background.color || !scene.background.file.empty())
            leaveOut(message<"part.feature-background">(), scene.background.where);
        if (scene.skybox) leaveOut(message<"part.feature-skybox">(), scene.skybox->where);
        if (scene.entity) leaveOut(message<"part.feature-entity">(), scene.where);
        for (const render::Instance& instance : subject_.placed().instances)
            if (instance.model->twoSided)
                return leaveOut(message<"part.feature-two-sided">(), instance.model->where);
    }

    Subject subject_;
    const std::string stem_;
    const std::size_t maxBytes_;
    std::string obj_;
    generator::io::Writer out_, library_;
    WrittenScene written_;
    std::uint64_t vertices_ = 0, uvs_ = 0, normals_ = 0;  ///< of the models before
    std::size_t besideBytes_ = 0;
    std::map<std::string, std::string> materials_;  ///< names by content
    std::map<std::string, std::string> images_;     ///< names by path and version
};

}  // namespace

WrittenScene writeObj(const render::Job& job, const std::string& stem, std::size_t maxBytes) {
    return ObjWriter(job, stem, maxBytes).write();
}

}  // namespace farol::interchange
