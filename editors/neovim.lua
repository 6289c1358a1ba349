-- RAPID in Neovim 0.7 or later: copy to ~/.config/nvim/plugin/rapid.lua.
-- Needs `pip install "rapidsim[edit]"` in a place that is on the PATH of Neovim.

local extensions = { "mod", "modx", "sys", "sysx", "prg" }
local servers = {} -- one a folder: a file's type may be set more than once
local group = vim.api.nvim_create_augroup("rapidsim", {})

vim.api.nvim_create_autocmd({ "BufRead", "BufNewFile" }, {
  group = group,
  pattern = vim.tbl_map(function(one) return "*." .. one end, extensions),
  callback = function() vim.bo.filetype = "rapid" end,
})

vim.api.nvim_create_autocmd("FileType", {
  group = group,
  pattern = "rapid",
  callback = function(event)
    vim.bo[event.buf].commentstring = "! %s"
    local found = vim.fs and vim.fs.find("rapidsim.toml", { upward = true, path = event.file })[1]
    local root = vim.fn.fnamemodify(found or event.file, ":p:h")
    if not (servers[root] and vim.lsp.get_client_by_id(servers[root])) then
      local command = { "rapidsim", "lsp" }
      servers[root] = vim.lsp.start_client({ name = "rapidsim", cmd = command, root_dir = root })
    end
    vim.lsp.buf_attach_client(event.buf, servers[root])
    local function map(keys, action) vim.keymap.set("n", keys, action, { buffer = event.buf }) end
    map("K", vim.lsp.buf.hover)
    map("gd", vim.lsp.buf.definition)
    map("gr", vim.lsp.buf.references)
    map("<leader>rn", vim.lsp.buf.rename)
    map("<leader>ca", vim.lsp.buf.code_action)
  end,
})
