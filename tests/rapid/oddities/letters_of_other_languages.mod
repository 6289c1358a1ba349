! Field practice, Characters: comments and strings in the language of the shop floor.
MODULE letters_of_other_languages
  ! Größe in mm, température, 位置, позиция
  PROC main()
    TPWrite "Größe erreicht";             ! -> Größe erreicht
    TPWrite "位置";                       ! -> 位置
    TPWrite ValToStr(StrLen("Größe"));    ! -> 5
  ENDPROC
ENDMODULE
