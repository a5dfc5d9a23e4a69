"""A wheel of the module: pip wheel tools/python. CMake builds it; docs/python.md says what it needs."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import sysconfig

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext

ROOT = pathlib.Path(__file__).resolve().parent.parent.parent


class CMakeBuild(build_ext):
    """The files of build/python/intarsia, as CMake puts them together for this interpreter."""

    def run(self):
        given = os.environ.get("INTARSIA_BUILD")  # built already: nothing is changed there
        build = ROOT / (given or "build/wheel")
        if not given:
            subprocess.run(["cmake", "-S", ROOT, "-B", build, "-G", "Ninja", "-D", "CMAKE_BUILD_TYPE=Release",
                            "-D", "INTARSIA_TESTS=OFF", "-D", f"INTARSIA_PYTHON={sys.executable}"], check=True)
            subprocess.run(["cmake", "--build", build, "--target", "intarsia_python"], check=True)
        module = build / "python" / "intarsia" / ("_core" + sysconfig.get_config_var("EXT_SUFFIX"))
        if not module.is_file():
            sys.exit(f"{module} is not there: it was not built, or for another interpreter than {sys.executable}")
        target = pathlib.Path(self.build_lib) / "intarsia"
        target.mkdir(parents=True, exist_ok=True)
        for file in sorted(module.parent.iterdir()):
            if file.is_file():
                shutil.copy2(file, target)


setup(
    name="intarsia",
    version=re.search(r"project\(\w+ VERSION ([\d.]+)", (ROOT / "CMakeLists.txt").read_text()).group(1),
    description="Patch layouts of triangle meshes along their ridges and valleys",
    packages=[],
    ext_modules=[Extension("intarsia._core", [])],
    cmdclass={"build_ext": CMakeBuild},
    install_requires=["numpy"],
    python_requires=">=3.9",
)
