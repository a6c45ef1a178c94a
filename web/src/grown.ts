/** By how much words and marks on the picture are larger than the picture's own pixels, as small.css states for large screens. */
export const grownOf = (element: Element): number => Number(getComputedStyle(element).getPropertyValue('--grown')) || 1;
