MODULE operator
  VAR num answer;
  VAR btnres key;
  CONST string buttons{3}:=["Yes","No","Cancel"];
  VAR listitem items{2}:=[["","Part A"],["","Part B"]];
  PROC main()
    TPErase;
    TPReadFK answer,"Select","Start","","","","Quit";
    IF answer=5 EXIT;
    TPReadNum answer,"How many?";
    key:=UIMessageBox(\Header:="Ready?"\MsgArray:=["The gripper","is open"]\BtnArray:=buttons\Icon:=iconInfo);
    answer:=UIListView(\Result:=key\Header:="Part",items\Buttons:=btnOKCancel\Icon:=iconInfo\DefaultIndex:=1);
    IF key=resOK TPWrite "Part "\Num:=answer;
    answer:=UINumEntry(\Header:="Speed"\Message:="mm/s"\InitValue:=100\MinValue:=1\MaxValue:=500\AsInteger);
    TPShow TP_LATEST;
  ENDPROC
ENDMODULE
