#include "render/gl/driver_environment.h"

#include <gtest/gtest.h>

namespace carom {
namespace {

TEST(DriverEnvironment, RefusesDriversWhosePixelsDiffer) {
    // GL_RENDERER as Mesa 22.3 (softpipe) and 21.3 (classic swrast) give it.
    for (const char* renderer : {"softpipe", "Software Rasterizer"}) {
        const std::string why = why_refused(renderer);
        EXPECT_NE(why.find(renderer), std::string::npos) << why;
        EXPECT_NE(why.find("libgl1-mesa-dri"), std::string::npos) << why;
    }
    EXPECT_EQ("", why_refused("llvmpipe (LLVM 15.0.6, 256 bits)"));
    EXPECT_EQ("", why_refused("NVIDIA H200/PCIe/SSE2"));
}

}  // namespace
}  // namespace carom
