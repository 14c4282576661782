// SPDX-License-Identifier: MIT
//
// The choice between certificates and starting anew, and there between searching and looking at
// everything, by what each way looked at so far for the same pair (internal/work.hpp).
#include <limits>
#include <memory>

#include "internal/certificates.hpp"
#include "internal/displacement.hpp"
#include "internal/finite.hpp"
#include "internal/jump.hpp"
#include "internal/strategies.hpp"

namespace gnomon::shadows::internal {

namespace {

// Below, all planes and edges cost less than the way through two hierarchies (docs/performance.md).
constexpr std::size_t few_faces = 2000;
// The same where nothing can be learned, so that a bad search would be repeated.
constexpr std::size_t few_faces_at_once = 6000;
// Certificates are not worth a try where the light goes some three degrees round the mesh at once.
constexpr double small_step = 0.05;
// They are judged after so many frames, first by what renewing them costs, then with the search
// that they began with.
constexpr std::uint32_t first_judgement = 4;
constexpr std::uint32_t judgement = 16;

class Automatic final : public SilhouetteDetector {
public:
    const Detection& detect(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) override {
        if (mesh_ == mesh.id() && near_caps_ == near_caps) {
            if (light.is_directional() != light_.is_directional()) return jump(mesh, light);
            if (by_certificates_) {
                ++frames_;
                const Certificates::Due due = certificates_->look(light);
                return due == Certificates::Due::Nothing ? *found_ : follow(mesh, light, due);
            }
            return light == light_ ? unchanged() : step_on(mesh, light);
        }
        return start(mesh, light, near_caps);
    }

    [[nodiscard]] Choice choice() const override { return choice_; }

    [[nodiscard]] std::size_t memory_bytes() const override {
        return sizeof *this + jump_.memory_bytes() +
               (certificates_ != nullptr ? certificates_->memory_bytes() : 0);
    }

private:
    const Detection& unchanged() {
        found_->changed = false;
        found_->stats = {};
        return *found_;
    }
    const Detection& start(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps);
    const Detection& jump(const ShadowMesh& mesh, LightLocal light);
    const Detection& step_on(const ShadowMesh& mesh, LightLocal light);
    const Detection& certify(const ShadowMesh& mesh, LightLocal light);
    const Detection& follow(const ShadowMesh& mesh, LightLocal light, Certificates::Due due);
    void judge_certificates(LightLocal light);
    void drop_certificates(LightLocal light);

    Jump jump_;
    std::unique_ptr<Certificates> certificates_;
    Detection* found_ = nullptr;  // of the last call
    std::uint64_t mesh_ = 0;
    NearCaps near_caps_ = NearCaps::Facing;
    // Of the last call; with certificates, of the last in which something was due.
    LightLocal light_;
    Choice choice_ = Choice::Jump;
    bool by_certificates_ = false;

    // Without certificates: what was found holds for so far about this place.
    LightLocal found_at_;
    double margin_ = 0.0;
    double jump_work_ = 0.0;
    Backoff trial_{judgement, 64};
    double failed_step_ = 0.0;

    // With them: what the search cost and the frames since then, which are less in number by one.
    double searching_ = 0.0;
    double renewing_ = 0.0;
    std::uint32_t frames_ = 0;
};

const Detection& Automatic::start(const ShadowMesh& mesh, LightLocal light, NearCaps near_caps) {
    if (mesh_ != mesh.id()) {
        mesh_ = mesh.id();
        jump_.forget();
        trial_.paid();
        certificates_.reset();
    }
    near_caps_ = near_caps;
    return jump(mesh, light);
}

const Detection& Automatic::jump(const ShadowMesh& mesh, LightLocal light) {
    const bool few = mesh.faces().size() < few_faces;
    Detection& found = jump_.detect(mesh, light, near_caps_, !few && !mesh.is_deformed());
    choice_ = mesh.is_deformed() ? Choice::Deforming
              : few              ? Choice::FewFaces
                                 : (jump_.searched() ? Choice::Jump : Choice::LargeSilhouette);
    jump_work_ = jump_.work();
    by_certificates_ = false;
    light_ = found_at_ = light;
    margin_ = found.margin;
    found_ = &found;
    return found;
}

// Nothing is known but how far the light may go.
const Detection& Automatic::step_on(const ShadowMesh& mesh, LightLocal light) {
    const double way = displacement(found_at_, light);
    if (way < margin_) {
        light_ = light;
        found_->margin = (margin_ - way) * (1.0 - std::numeric_limits<double>::epsilon());
        return unchanged();
    }
    if (mesh.is_deformed() || !is_finite(light.position)) return jump(mesh, light);
    const double distance =
        light.is_directional()
            ? 1.0
            : glm::length(glm::dvec3(light.position) - glm::dvec3(mesh.planes().origin));
    const double step = displacement(light_, light);
    if (!(step < small_step * distance)) return jump(mesh, light);
    if (step < 0.5 * failed_step_) trial_.paid();
    return trial_.is_due() ? certify(mesh, light) : jump(mesh, light);
}

const Detection& Automatic::certify(const ShadowMesh& mesh, LightLocal light) {
    if (certificates_ == nullptr) certificates_ = std::make_unique<Certificates>();
    certificates_->search(mesh, light, near_caps_);
    jump_work_ = certificates_->jump_work();
    searching_ = certificates_->work();
    renewing_ = 0.0;
    frames_ = 1;
    choice_ = Choice::SmallStep;
    by_certificates_ = true;
    light_ = light;
    found_ = &certificates_->found();
    return *found_;
}

const Detection& Automatic::follow(const ShadowMesh& mesh, LightLocal light,
                                   Certificates::Due due) {
    if (due == Certificates::Due::Some) {
        certificates_->renew(mesh);
        renewing_ += certificates_->work();
        if (frames_ >= first_judgement) judge_certificates(light);
        light_ = light;
        return *found_;
    }
    // The next certificates will last as long as these did.
    const bool worth_it = searching_ + renewing_ < (frames_ - 1) * jump_work_;
    if (worth_it && is_finite(light.position)) return certify(mesh, light);
    drop_certificates(light);
    return jump(mesh, light);
}

void Automatic::judge_certificates(LightLocal light) {
    if (renewing_ > (frames_ - 1) * jump_work_) {
        drop_certificates(light);
        return;
    }
    if (frames_ < judgement) return;
    if (searching_ + renewing_ > frames_ * jump_work_) {
        drop_certificates(light);
        return;
    }
    trial_.paid();
    failed_step_ = 0.0;
    // What is long ago counts less.
    searching_ *= 0.5;
    renewing_ *= 0.5;
    frames_ /= 2;
}

void Automatic::drop_certificates(LightLocal light) {
    trial_.failed();
    failed_step_ = displacement(light_, light);
    by_certificates_ = false;
    found_at_ = light;
    margin_ = 0.0;  // the next light is looked at anew
}

}  // namespace

Choice choose_for_jump(const ShadowMesh& mesh) {
    if (mesh.is_deformed()) return Choice::Deforming;
    return mesh.faces().size() < few_faces_at_once ? Choice::FewFaces : Choice::Jump;
}

std::unique_ptr<SilhouetteDetector> automatic_detector() { return std::make_unique<Automatic>(); }

}  // namespace gnomon::shadows::internal
