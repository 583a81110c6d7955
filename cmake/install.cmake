# What `cmake --install` puts where, and the Debian packages that `scripts/package` makes of it:
# farol (the program, scenes, schemas, man pages, completions, service) and farol-openexr (the
# module that reads .exr files, with the many libraries of OpenImageIO).
include(GNUInstallDirs)

set(manual ${CMAKE_BINARY_DIR}/manual)
install(CODE "
    execute_process(COMMAND ${CMAKE_COMMAND} -DFAROL=$<TARGET_FILE:farol> -DOUT=${manual}
                            -P ${CMAKE_SOURCE_DIR}/cmake/manual.cmake
                    COMMAND_ERROR_IS_FATAL ANY)" COMPONENT farol)
install(TARGETS farol RUNTIME COMPONENT farol)
if(TARGET farol_oiio)
    # Not the multiarch folder: the program looks for it beside its own prefix.
    install(TARGETS farol_oiio LIBRARY DESTINATION lib/farol COMPONENT farol-openexr)
endif()
if(TARGET farol_video)
    install(TARGETS farol_video LIBRARY DESTINATION lib/farol COMPONENT farol-video)
endif()
install(DIRECTORY scenes/ DESTINATION ${CMAKE_INSTALL_DATADIR}/farol/scenes COMPONENT farol
        PATTERN make EXCLUDE PATTERN make_textures.py EXCLUDE PATTERN refused EXCLUDE
        PATTERN __pycache__ EXCLUDE)
install(FILES api/scene.xsd api/rubric.schema.json api/openapi.yaml
        DESTINATION ${CMAKE_INSTALL_DATADIR}/farol/schema COMPONENT farol)
install(FILES README.md CHANGELOG.md NOTICE DESTINATION ${CMAKE_INSTALL_DOCDIR} COMPONENT farol)
# The pages for users, with the tutorial's images; the folders are as here, so that links hold.
install(FILES docs/README.md docs/scene-language.md docs/grading.md
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT farol)
install(DIRECTORY docs/tutorial docs/how-to docs/reference docs/explanation
        DESTINATION ${CMAKE_INSTALL_DOCDIR}/docs COMPONENT farol PATTERN "contributor-*" EXCLUDE)
install(FILES api/errors.md DESTINATION ${CMAKE_INSTALL_DOCDIR}/api COMPONENT farol)
install(DIRECTORY api/examples DESTINATION ${CMAKE_INSTALL_DOCDIR}/api COMPONENT farol
        PATTERN __pycache__ EXCLUDE)
install(DIRECTORY ${manual}/man1 DESTINATION ${CMAKE_INSTALL_MANDIR} COMPONENT farol)
install(FILES ${manual}/farol.bash RENAME farol
        DESTINATION ${CMAKE_INSTALL_DATADIR}/bash-completion/completions COMPONENT farol)
install(FILES ${manual}/farol.zsh RENAME _farol
        DESTINATION ${CMAKE_INSTALL_DATADIR}/zsh/vendor-completions COMPONENT farol)
install(FILES ${manual}/farol.fish
        DESTINATION ${CMAKE_INSTALL_DATADIR}/fish/vendor_completions.d COMPONENT farol)

# ---- Debian packages
option(FAROL_PACKAGE "Install what only the Debian packages hold: the service and its settings" OFF)
if(NOT FAROL_PACKAGE)
    return()
endif()
# As Debian's own tools take it; packages for others need a real address.
set(maintainer "The Farol authors <farol@localhost>")
if(DEFINED ENV{DEBFULLNAME} AND DEFINED ENV{DEBEMAIL})
    set(maintainer "$ENV{DEBFULLNAME} <$ENV{DEBEMAIL}>")
endif()
string(TIMESTAMP now "%a, %d %b %Y %H:%M:%S +0000" UTC)  # of SOURCE_DATE_EPOCH, where it is set
file(WRITE ${manual}/changelog "farol (${PROJECT_VERSION}) bookworm; urgency=medium

  * /usr/share/doc/farol/CHANGELOG.md lists the changes.

 -- ${maintainer}  ${now}
")
execute_process(COMMAND gzip -9nf ${manual}/changelog COMMAND_ERROR_IS_FATAL ANY)
install(FILES packaging/farol.service DESTINATION /lib/systemd/system COMPONENT farol)
install(FILES packaging/farol.toml DESTINATION /etc/farol COMPONENT farol)
foreach(package farol farol-openexr)
    install(FILES packaging/copyright DESTINATION share/doc/${package} COMPONENT ${package})
    install(FILES ${manual}/changelog.gz DESTINATION share/doc/${package} COMPONENT ${package})
endforeach()
install(FILES packaging/lintian-overrides RENAME farol
        DESTINATION share/lintian/overrides COMPONENT farol)
install(FILES packaging/lintian-overrides-openexr RENAME farol-openexr
        DESTINATION share/lintian/overrides COMPONENT farol-openexr)

set(CPACK_GENERATOR DEB)
set(CPACK_PACKAGE_NAME farol)
set(CPACK_PACKAGE_VENDOR "The Farol authors")
set(CPACK_PACKAGE_CONTACT "${maintainer}")
set(CPACK_PACKAGE_VERSION ${PROJECT_VERSION})
set(CPACK_PACKAGING_INSTALL_PREFIX /usr)
set(CPACK_COMPONENTS_ALL farol farol-openexr)
set(CPACK_COMPONENTS_GROUPING IGNORE)
set(CPACK_STRIP_FILES ON)
set(CPACK_INSTALL_DEFAULT_DIRECTORY_PERMISSIONS
    OWNER_READ OWNER_WRITE OWNER_EXECUTE GROUP_READ GROUP_EXECUTE WORLD_READ WORLD_EXECUTE)
set(CPACK_DEB_COMPONENT_INSTALL ON)
set(CPACK_DEBIAN_FILE_NAME DEB-DEFAULT)
set(CPACK_DEBIAN_PACKAGE_SECTION graphics)
set(CPACK_DEBIAN_PACKAGE_PRIORITY optional)
set(CPACK_DEBIAN_ENABLE_COMPONENT_DEPENDS OFF)
set(CPACK_DEBIAN_FAROL_PACKAGE_NAME farol)
set(CPACK_DEBIAN_FAROL_PACKAGE_SHLIBDEPS ON)
# The library that draws is loaded at run time: OSMesa, or EGL with Mesa's driver.
set(CPACK_DEBIAN_FAROL_PACKAGE_DEPENDS "adduser, libosmesa6 | libegl1, libosmesa6 | libgl1-mesa-dri")
set(CPACK_DEBIAN_FAROL_PACKAGE_SUGGESTS "farol-openexr")
set(CPACK_DEBIAN_FAROL_PACKAGE_CONTROL_EXTRA
    ${CMAKE_SOURCE_DIR}/packaging/conffiles ${CMAKE_SOURCE_DIR}/packaging/postinst
    ${CMAKE_SOURCE_DIR}/packaging/prerm ${CMAKE_SOURCE_DIR}/packaging/postrm)
set(CPACK_DEBIAN_FAROL_PACKAGE_CONTROL_STRICT_PERMISSION ON)
set(CPACK_COMPONENT_FAROL_DESCRIPTION "renders and grades XML scenes of graphics courses
Farol reads the XML scenes that students of computer graphics courses write,
makes the meshes that they name, and renders them without a screen or a
graphics card: on the command line, over HTTP and on a web page. It compares
a class's submissions with a reference and explains the differences.")
set(CPACK_DEBIAN_FAROL-OPENEXR_PACKAGE_NAME farol-openexr)
set(CPACK_DEBIAN_FAROL-OPENEXR_PACKAGE_SHLIBDEPS ON)
set(CPACK_DEBIAN_FAROL-OPENEXR_PACKAGE_DEPENDS "farol (= ${PROJECT_VERSION})")
set(CPACK_COMPONENT_FAROL-OPENEXR_DESCRIPTION "OpenEXR images for the farol scene renderer
The module with which farol reads .exr textures and backgrounds. It depends
on OpenImageIO and the many libraries that come with it.")
include(CPack)
