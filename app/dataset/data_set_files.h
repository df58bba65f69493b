#pragma once

#include <filesystem>
#include <string>

#include "app/dataset/data_set.h"
#include "app/sense/picture_files.h"
#include "engine/io/output_check.h"

namespace pedicel::app {

/// Of everything that decides what its pictures are, the number of them left out.
std::string identity_of(const DataSetOptions& options);

/// Takes the folder, for as long as the lock lives: an empty one, or one with a data set of the
/// same identity that nobody else is making. Throws io::WriteError else.
io::FolderLock take_data_set_folder(const DataSetOptions& options);

/// "000042"
std::string picture_name(long picture);
/// What is known of a picture once all of its files are there: its entry of COCO's `images`, and
/// its annotations.
std::filesystem::path labels_file(const std::filesystem::path& folder, long picture);

/// Reads one. Throws InvalidFile where it is none.
Json read_labels(const std::filesystem::path& file);

/// Annotations of all pictures from 0 on, as COCO has them: all.json and one file a split. Returns
/// how many annotations there are.
long write_coco(const DataSetOptions& options);

/// contact_sheet.png of the first pictures.
void write_contact_sheet(const DataSetOptions& options);

}  // namespace pedicel::app
