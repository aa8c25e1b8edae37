#include "render/element/element.h"

namespace carom {

const Image& Element::picture() const {
    static const Image none;
    return none;
}

}  // namespace carom
