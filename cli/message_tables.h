#pragma once

#include <span>
#include <vector>

#include "cli/messages.h"
#include "core/messages.h"
#include "generator/compare/messages.h"
#include "generator/messages.h"
#include "grade/messages.h"
#include "grade/report/messages.h"
#include "grade/report/student_messages.h"
#include "grade/requirements/messages.h"
#include "grade/rubric/kind_messages.h"
#include "grade/structure/messages.h"
#include "image/messages.h"
#include "interchange/messages.h"
#include "render/plan/messages.h"
#include "scene/messages.h"
#include "server/messages.h"
#include "worker/messages.h"

namespace farol::cli {

/// The message tables of all floors, from core upwards.
inline std::vector<std::span<const MessageRow>> messageTables() {
    return {kCoreMessages,
            image::kImageMessages,
            scene::kReadMessages,
            scene::kRepairMessages,
            scene::kFilesMessages,
            generator::kMeshMessages,
            generator::kGeneratorMessages,
            generator::kCheckMessages,
            render::kRenderMessages,
            interchange::kInterchangeMessages,
            grade::kGradeMessages,
            grade::kKindMessages,
            grade::kCauseMessages,
            grade::kReportMessages,
            grade::kRequirementMessages,
            grade::kStudentMessages,
            worker::kWorkerMessages,
            server::kServerMessages,
            cli::kCliMessages};
}

/// Finds the English template of an id.
inline std::optional<std::string_view> englishTemplate(std::string_view id) {
    for (const std::span<const MessageRow> table : messageTables())
        for (const MessageRow& row : table)
            if (row.id == id) return row.text;
    return std::nullopt;
}

}  // namespace farol::cli
