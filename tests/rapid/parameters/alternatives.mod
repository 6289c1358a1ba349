! RAPID Kernel, Optional parameters: of those parted by a bar one may be given.
MODULE alternatives
  PROC main()
    open_hand;
    open_hand\slow;
    open_hand\fast;
    open_hand\width:=20;
  ENDPROC

  PROC open_hand(\switch slow|switch fast|num width)
    IF Present(slow) TPWrite "slow";                ! -> slow
    IF Present(fast) TPWrite "fast";                ! -> fast
    IF Present(width) TPWrite "width "\Num:=width;  ! -> width 20
  ENDPROC
ENDMODULE
