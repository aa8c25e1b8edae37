#include "render/painter.h"

#include "render/picture/side_by_side.h"
#include "render/picture/single_picture.h"

namespace carom {

namespace {

std::unique_ptr<Picture> make_picture(const Scene& scene, const Motion& motion,
                                      const PainterOptions& options) {
    if (options.second != nullptr && options.second->view == AgainstView::kSide)
        return std::make_unique<SideBySide>(scene, motion, options);
    return make_single_picture(scene, motion, options);
}

}  // namespace

Painter::Painter(const Scene& scene, const Motion& motion, const PainterOptions& options)
    : picture_(make_picture(scene, motion, options)) {}
Painter::~Painter() = default;
Painter::Painter(Painter&&) noexcept = default;
Painter& Painter::operator=(Painter&&) noexcept = default;

void Painter::paint(double t, Image& out) { paint_strobe({t}, out); }
ChangedParts Painter::paint_next(double t, Image& picture) {
    return picture_->paint_next(t, picture);
}
bool Painter::draws_each_anew() const { return picture_->draws_each_anew(); }
void Painter::paint_strobe(const std::vector<double>& instants, Image& out) {
    picture_->paint(instants, out);
}
std::string Painter::renderer() const { return picture_->renderer(); }
std::map<std::string, DrawnEffect> Painter::effects() const { return picture_->effects(); }
double Painter::draw_cpu_s() const { return picture_->draw_cpu_s(); }
double Painter::read_cpu_s() const { return picture_->read_cpu_s(); }

}  // namespace carom
