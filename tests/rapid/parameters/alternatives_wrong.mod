! RAPID Kernel, Optional parameters: no two of a group, none twice, no value for a switch.
MODULE alternatives_wrong
  PROC main()
    open_hand\slow\fast;                  ! error: T315
    open_hand\slow\slow;                  ! error: T315
    open_hand\slow:=TRUE;                 ! error: T315
    open_hand\width;                      ! error: T315
    open_hand\wide;                       ! error: T312
    ConfL\On\Off;                         ! error: T315
  ENDPROC

  PROC open_hand(\switch slow|switch fast\num width)
  ENDPROC
ENDMODULE
