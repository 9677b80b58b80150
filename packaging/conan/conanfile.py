"""A recipe for Conan 2: conan create packaging/conan. ODE is the system's, which Conan has no package of.

NOT RUN: no package has ever been made by it.
"""
import re
from pathlib import Path

from conan import ConanFile
from conan.tools.cmake import CMake, CMakeToolchain, cmake_layout
from conan.tools.files import copy
from conan.tools.system.package_manager import Apt, Dnf, PacMan

SOURCES = "../.."
EXPORTED = ("CMakeLists.txt", "LICENSE", "include/*", "ode_predictive_space/*", "packaging/*")


class OdePredictiveSpace(ConanFile):
    name = "ode-predictive-space"
    description = "A collision space for the Open Dynamics Engine that predicts when geoms can come near each other"
    license = "BSD-3-Clause"
    settings = "os", "arch", "compiler", "build_type"
    package_type = "shared-library"
    requires = "eigen/[>=3.3]"
    generators = "CMakeDeps"

    def set_version(self):
        text = (Path(self.recipe_folder) / SOURCES / "CMakeLists.txt").read_text()
        self.version = re.search(r"^ +VERSION ([0-9.]+)$", text, re.MULTILINE)[1]

    def export_sources(self):
        for pattern in EXPORTED:
            copy(self, pattern, Path(self.recipe_folder) / SOURCES, self.export_sources_folder)

    def requirements(self):
        if self.settings.arch != "x86_64":
            self.requires("simde/[>=0.7.4]")

    def layout(self):
        cmake_layout(self)

    def system_requirements(self):
        Apt(self).install(["libode-dev"])
        Dnf(self).install(["ode-devel"])
        PacMan(self).install(["ode"])

    def generate(self):
        toolchain = CMakeToolchain(self)
        toolchain.cache_variables.update({
            "ODE_SOURCE_DIR": "",
            "ODE_PREDICTIVE_SPACE_BUILD_TESTS": False,
            "ODE_PREDICTIVE_SPACE_BUILD_DEMOS": False
        })
        toolchain.generate()

    def build(self):
        cmake = CMake(self)
        cmake.configure()
        cmake.build()

    def package(self):
        CMake(self).install()
        copy(self, "LICENSE", self.source_folder, str(Path(self.package_folder) / "licenses"))

    def package_info(self):
        self.cpp_info.set_property("cmake_find_mode", "none")
        self.cpp_info.builddirs = ["lib/cmake/ode_predictive_space"]
        self.cpp_info.libs = ["ode_predictive_space_haptics", "ode_predictive_space"]
