// SPDX-License-Identifier: MIT
//
// Files that are chosen, or dropped anywhere on the page: a browser would leave the page for one that is let go beside the
// picture, so this listens from the beginning.

const hasFiles = event => event.dataTransfer?.types.includes('Files');

/// `open(file)` hears of each; `stage` has the class "over" while one hangs over the page.
export function listenToFiles({input, stage, open}) {
    input.addEventListener('change', () => {
        const [file] = input.files;
        input.value = '';  // so that the same one can be chosen again
        if (file) open(file);
    });
    document.addEventListener('dragover', event => {
        if (!hasFiles(event)) return;
        event.preventDefault();
        stage.classList.add('over');
    });
    document.addEventListener('dragleave', event => {
        if (!event.relatedTarget) stage.classList.remove('over');  // out of the page
    });
    document.addEventListener('drop', event => {
        if (!hasFiles(event)) return;
        event.preventDefault();
        stage.classList.remove('over');
        const [file] = event.dataTransfer.files;
        if (file) open(file);
    });
}
