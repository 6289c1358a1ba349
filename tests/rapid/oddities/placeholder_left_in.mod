! Field practice, Placeholders: one that is never reached does no harm.
MODULE placeholder_left_in
  PROC main()
    TPWrite "running";                    ! -> running
    IF FALSE THEN
      <SMT>                               ! warning: E148
    ENDIF
    TPWrite "done";                       ! -> done
  ENDPROC
ENDMODULE
