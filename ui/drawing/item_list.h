// Many items as a value that is cheap to copy: copies share what they have in common.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <iterator>
#include <memory>
#include <utility>
#include <vector>

namespace marsview {

/// A sequence of items with ascending `id`s, in blocks that copies share until one of them changes
/// an item of a block. A step of undo over a hundred thousand items so holds the changed block and
/// the list of blocks, not all items. `Item` is copyable and comparable. No thread safety beyond
/// that of a vector.
template <typename Item>
class ItemList {
    using Block = std::vector<Item>;
    // With the id of its first item, so that a search reads no items.
    struct Slot {
        std::shared_ptr<Block> items;
        std::uint32_t first_id = 0;

        bool operator==(const Slot&) const = default;
    };
    using Blocks = std::vector<Slot>;

public:
    class Iterator {
    public:
        using iterator_category = std::bidirectional_iterator_tag;
        using value_type = Item;
        using difference_type = std::ptrdiff_t;
        using pointer = const Item*;
        using reference = const Item&;

        Iterator() = default;
        reference operator*() const { return (*(*blocks_)[block_].items)[index_]; }
        pointer operator->() const { return &**this; }
        Iterator& operator++()
        {
            if (++index_ == (*blocks_)[block_].items->size()) {
                ++block_;
                index_ = 0;
            }
            return *this;
        }
        Iterator operator++(int)
        {
            Iterator before = *this;
            ++*this;
            return before;
        }
        Iterator& operator--()
        {
            if (index_ == 0) {
                --block_;
                index_ = (*blocks_)[block_].items->size();
            }
            --index_;
            return *this;
        }
        Iterator operator--(int)
        {
            Iterator before = *this;
            --*this;
            return before;
        }
        bool operator==(const Iterator& other) const
        {
            return block_ == other.block_ && index_ == other.index_;
        }

    private:
        friend class ItemList;
        Iterator(const Blocks& blocks, std::size_t block, std::size_t index)
            : blocks_(&blocks)
            , block_(block)
            , index_(index)
        {}

        const Blocks* blocks_ = nullptr;
        std::size_t block_ = 0;
        std::size_t index_ = 0;
    };
    using value_type = Item;
    using const_iterator = Iterator;
    using const_reverse_iterator = std::reverse_iterator<Iterator>;

    std::size_t size() const noexcept { return size_; }
    bool empty() const noexcept { return size_ == 0; }
    Iterator begin() const { return {blocks_, 0, 0}; }
    Iterator end() const { return {blocks_, blocks_.size(), 0}; }
    const_reverse_iterator rbegin() const { return const_reverse_iterator(end()); }
    const_reverse_iterator rend() const { return const_reverse_iterator(begin()); }
    /// Not for an empty list.
    const Item& front() const { return blocks_.front().items->front(); }
    const Item& back() const { return blocks_.back().items->back(); }
    /// Takes as long as there are blocks.
    const Item& operator[](std::size_t index) const
    {
        std::size_t block = 0;
        while (index >= blocks_[block].items->size()) {
            index -= blocks_[block++].items->size();
        }
        return (*blocks_[block].items)[index];
    }

    /// Null if there is no such item. Takes logarithmic time.
    const Item* find(std::uint32_t id) const
    {
        const auto block = blockOf(id);
        if (block == blocks_.size()) {
            return nullptr;
        }
        const Block& items = *blocks_[block].items;
        const auto hit = placeIn(items, id);
        return hit != items.end() && hit->id == id ? &*hit : nullptr;
    }
    /// The same to change it; not its id. Valid until the list is changed or copied.
    Item* edit(std::uint32_t id)
    {
        const auto block = blockOf(id);
        if (block == blocks_.size() || find(id) == nullptr) {
            return nullptr;
        }
        Block& own = unshared(block);
        return &*placeIn(own, id);
    }

    /// With a greater id than all before. Returns the item as edit() does.
    Item& push_back(Item item)
    {
        if (blocks_.empty() || blocks_.back().items->size() >= kBlockItems) {
            blocks_.push_back({.items = std::make_shared<Block>(), .first_id = item.id});
        }
        Block& own = unshared(blocks_.size() - 1);
        own.push_back(std::move(item));
        ++size_;
        return own.back();
    }
    void clear()
    {
        blocks_.clear();
        size_ = 0;
    }
    /// Removes the items that a predicate is true for.
    template <typename Predicate>
    void eraseIf(const Predicate& is_meant)
    {
        for (std::size_t block = 0; block < blocks_.size(); ++block) {
            const Block& items = *blocks_[block].items;
            if (std::any_of(items.begin(), items.end(), is_meant)) {
                Block& own = unshared(block);
                size_ -= std::erase_if(own, is_meant);
                blocks_[block].first_id = own.empty() ? 0 : own.front().id;
            }
        }
        std::erase_if(blocks_, [](const Slot& slot) { return slot.items->empty(); });
    }

    /// Compares shared blocks at a glance.
    bool operator==(const ItemList& other) const
    {
        return size_ == other.size_ &&
               compare(*this, other, [](const Item*, const Item*) { return false; });
    }

    /// Calls `change(was, is)` for what differs between two lists, in the order of the ids. `was`
    /// is null for an item that is new, `is` for one that was removed. Takes as long as the blocks
    /// that differ, with a glance at the others.
    template <typename Change>
    static void forEachChange(const ItemList& before, const ItemList& after, const Change& change)
    {
        compare(before, after, [&change](const Item* was, const Item* is) {
            change(was, is);
            return true;
        });
    }

private:
    static constexpr std::size_t kBlockItems = 256;

    // Until `change` returns false; false in this case.
    template <typename Change>
    static bool compare(const ItemList& before, const ItemList& after, const Change& change)
    {
        Iterator a = before.begin();
        Iterator b = after.begin();
        const Iterator a_end = before.end();
        const Iterator b_end = after.end();
        while (!(a == a_end) || !(b == b_end)) {
            const bool has_both = !(a == a_end) && !(b == b_end);
            if (has_both && a.index_ == 0 && b.index_ == 0 &&
                before.blocks_[a.block_].items == after.blocks_[b.block_].items) {
                ++a.block_;
                ++b.block_;
            } else if (has_both && a->id == b->id) {
                if (!(*a == *b) && !change(&*a, &*b)) {
                    return false;
                }
                ++a;
                ++b;
            } else if (b == b_end || (has_both && a->id < b->id)) {
                if (!change(&*a, nullptr)) {
                    return false;
                }
                ++a;
            } else {
                if (!change(nullptr, &*b)) {
                    return false;
                }
                ++b;
            }
        }
        return true;
    }

    std::size_t blockOf(std::uint32_t id) const
    {
        const auto after = std::upper_bound(
            blocks_.begin(), blocks_.end(), id,
            [](std::uint32_t wanted, const Slot& slot) { return wanted < slot.first_id; });
        return after == blocks_.begin() ? blocks_.size()
                                        : static_cast<std::size_t>(after - blocks_.begin()) - 1;
    }
    template <typename Items>
    static auto placeIn(Items& items, std::uint32_t id)
    {
        // Without gaps, the place follows from the id.
        const std::uint32_t first = items.front().id;
        if (id >= first && id - first < items.size() && items[id - first].id == id) {
            return items.begin() + static_cast<std::ptrdiff_t>(id - first);
        }
        return std::lower_bound(
            items.begin(), items.end(), id,
            [](const Item& item, std::uint32_t wanted) { return item.id < wanted; });
    }
    Block& unshared(std::size_t block)
    {
        std::shared_ptr<Block>& items = blocks_[block].items;
        if (items.use_count() > 1) {
            items = std::make_shared<Block>(*items);
        }
        return *items;
    }

    Blocks blocks_;
    std::size_t size_ = 0;
};

} // namespace marsview
