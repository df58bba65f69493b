#pragma once

#include <string>
#include <vector>

namespace pedicel::io {
struct KeyList;
}

namespace pedicel::app {

/// Pages with tables of the keys of a file ("scene_file").
std::vector<std::string> pages_of_keys();

/// The keys of all maps of the file that a page is about. Asserts that the page has such.
std::vector<const io::KeyList*> keys_of_page(const std::string& page);

/// A file that the program reads has defaults; of one that it writes, keys may be absent.
enum class KeysOf { read_file, written_file };

/// One table with a row a key: name, type, unit, default (or when it is absent), bounds, sentence.
std::string key_table(const std::vector<const io::KeyList*>& lists,
                      KeysOf kind = KeysOf::read_file);

/// The page with its tables as the program describes the keys. A table stands between
/// `<!-- keys: NAME NAME -->`, the lists that it has, and `<!-- end of keys -->`. Throws
/// std::runtime_error where a list is unknown, comes twice or is missing, or a table has no end.
std::string with_key_tables(const std::string& page, const std::string& text);

}  // namespace pedicel::app
