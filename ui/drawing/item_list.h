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
    using Blocks = std::vector<std::shared_ptr<Block>>;

public:
    class Iterator {
    public:
        using iterator_category = std::bidirectional_iterator_tag;
        using value_type = Item;
        using difference_type = std::ptrdiff_t;
        using pointer = const Item*;
        using reference = const Item&;

        Iterator() = default;
        reference operator*() const { return (*(*blocks_)[block_])[index_]; }
        pointer operator->() const { return &**this; }
        Iterator& operator++()
        {
            if (++index_ == (*blocks_)[block_]->size()) {
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
                index_ = (*blocks_)[block_]->size();
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
    const Item& front() const { return blocks_.front()->front(); }
    const Item& back() const { return blocks_.back()->back(); }
    /// Takes as long as there are blocks.
    const Item& operator[](std::size_t index) const
    {
        std::size_t block = 0;
        while (index >= blocks_[block]->size()) {
            index -= blocks_[block++]->size();
        }
        return (*blocks_[block])[index];
    }

    /// Null if there is no such item. Takes logarithmic time.
    const Item* find(std::uint32_t id) const
    {
        const auto block = blockOf(id);
        if (block == blocks_.size()) {
            return nullptr;
        }
        const auto hit = placeIn(*blocks_[block], id);
        return hit != blocks_[block]->end() && hit->id == id ? &*hit : nullptr;
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
        if (blocks_.empty() || blocks_.back()->size() >= kBlockItems) {
            blocks_.push_back(std::make_shared<Block>());
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
            if (std::any_of(blocks_[block]->begin(), blocks_[block]->end(), is_meant)) {
                Block& own = unshared(block);
                size_ -= std::erase_if(own, is_meant);
            }
        }
        std::erase_if(blocks_, [](const auto& block) { return block->empty(); });
    }

    /// Compares shared blocks at a glance.
    bool operator==(const ItemList& other) const
    {
        if (size_ != other.size_) {
            return false;
        }
        if (blocks_ == other.blocks_) {
            return true;
        }
        if (blocks_.size() == other.blocks_.size()) {
            const bool is_same =
                std::equal(blocks_.begin(), blocks_.end(), other.blocks_.begin(),
                           [](const auto& a, const auto& b) { return a == b || *a == *b; });
            if (is_same) {
                return true;
            }
        }
        return std::equal(begin(), end(), other.begin());
    }

private:
    static constexpr std::size_t kBlockItems = 256;

    std::size_t blockOf(std::uint32_t id) const
    {
        const auto after =
            std::upper_bound(blocks_.begin(), blocks_.end(), id,
                             [](std::uint32_t wanted, const std::shared_ptr<Block>& block) {
                                 return wanted < block->front().id;
                             });
        return after == blocks_.begin() ? blocks_.size()
                                        : static_cast<std::size_t>(after - blocks_.begin()) - 1;
    }
    template <typename Items>
    static auto placeIn(Items& items, std::uint32_t id)
    {
        return std::lower_bound(
            items.begin(), items.end(), id,
            [](const Item& item, std::uint32_t wanted) { return item.id < wanted; });
    }
    Block& unshared(std::size_t block)
    {
        if (blocks_[block].use_count() > 1) {
            blocks_[block] = std::make_shared<Block>(*blocks_[block]);
        }
        return *blocks_[block];
    }

    Blocks blocks_;
    std::size_t size_ = 0;
};

} // namespace marsview
